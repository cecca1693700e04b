#include "references/data/reference.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reference)

using namespace trammel::references;

BOOST_AUTO_TEST_CASE(printed_value_is_uncertain_by_half_a_last_unit) {
  BOOST_TEST(half_unit_in_last_place("12.768") == 5e-4);
  BOOST_TEST(half_unit_in_last_place("1.2e-2") == 5e-4);
  BOOST_TEST(half_unit_in_last_place("6.9e10") == 5e8);
  BOOST_TEST(half_unit_in_last_place("5") == 0.5);
}

BOOST_AUTO_TEST_CASE(text_that_is_no_decimal_number_is_refused) {
  for (const char* text : {"", "twelve", "0x1p3", "nan", "1.2 mm"})
    BOOST_CHECK_THROW(static_cast<void>(half_unit_in_last_place(text)), ReferenceError);
}

BOOST_AUTO_TEST_SUITE_END()
