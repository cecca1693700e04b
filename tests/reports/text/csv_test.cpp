#include <boost/test/unit_test.hpp>

#include "reports/text/files.h"

BOOST_AUTO_TEST_SUITE(csv)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(numbers_keep_all_digits_and_texts_are_quoted) {
  const Table table{{"time_s", "title, free"}, {{0.1 + 0.2, std::string("say \"no\"")}, {{}, {}}}};
  BOOST_TEST(to_csv(table) ==
             "time_s,\"title, free\"\n0.30000000000000004,\"say \"\"no\"\"\"\n,\n");
}

BOOST_AUTO_TEST_CASE(text_cannot_become_a_formula_or_control_a_terminal) {
  for (const char* text : {"=1+1", "-2+3", "@sum", "-cmd", "-(1)"}) {
    const Table table{{"h"}, {{std::string(text)}}};
    BOOST_TEST(to_csv(table) == "h\n'" + std::string(text) + "\n");
  }
  BOOST_TEST(to_csv({{"h"}, {{std::string("-0.5")}}}) == "h\n-0.5\n");
  BOOST_TEST(to_csv({{"h"}, {{std::string("a\x1b[2J")}}}) == "h\na [2J\n");
}

BOOST_AUTO_TEST_SUITE_END()
