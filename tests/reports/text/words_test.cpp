#include <boost/test/unit_test.hpp>

#include "reports/text/number.h"

BOOST_AUTO_TEST_SUITE(words)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(names_read_as_words) {
  BOOST_TEST(separators_to_spaces("axial-flexibility_of") == "axial flexibility of");
  BOOST_TEST(capitalized("modes") == "Modes");
  BOOST_TEST(capitalized("") == "");
  BOOST_TEST(words_in("case  variant ") == (std::vector<std::string>{"case", "variant"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(range_with_equal_ends_is_one_number) {
  BOOST_TEST(low_to_high("3.9", "4.1") == "3.9 to 4.1");
  BOOST_TEST(low_to_high("4", "4") == "4");
}

BOOST_AUTO_TEST_CASE(first_item_of_a_list_has_no_separator) {
  std::string list;
  add_item(list, "a");
  add_item(list, "b");
  add_item(list, "c", "; ");
  BOOST_TEST(list == "a, b; c");
}

BOOST_AUTO_TEST_SUITE_END()
