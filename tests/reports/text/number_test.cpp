#include "reports/text/number.h"

#include <boost/test/unit_test.hpp>
#include <limits>

BOOST_AUTO_TEST_SUITE(number)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(numbers_have_significant_digits) {
  BOOST_TEST(rounded_text(12.768, 4) == "12.77");
  BOOST_TEST(rounded_text(9.9996, 4) == "10.00");
  BOOST_TEST(rounded_text(0.0234, 3) == "0.0234");
  BOOST_TEST(trimmed(0.002, 4) == "0.002");
  BOOST_TEST(trimmed(631, 4) == "631");
  BOOST_TEST(trimmed(-3, 2) == "\u22123");
}

BOOST_AUTO_TEST_CASE(very_small_and_large_numbers_are_powers_of_ten) {
  BOOST_TEST(trimmed(1e-7, 3) == "10⁻⁷");
  BOOST_TEST(trimmed(-1e-7, 3) == "\u221210⁻⁷");
  BOOST_TEST(trimmed(3.456e-9, 2) == "3.5\u202f×\u202f10⁻⁹");
  BOOST_TEST(trimmed(6.9e10, 3) == "6.9\u202f×\u202f10¹⁰");
}

BOOST_AUTO_TEST_CASE(nan_infinity_and_missing_have_no_digits) {
  BOOST_TEST(trimmed(std::numeric_limits<double>::quiet_NaN(), 3) == "not a number");
  BOOST_TEST(trimmed(std::numeric_limits<double>::infinity(), 3) == "∞");
  BOOST_TEST(text_or_dash(std::nullopt, 3) == "–");
}

BOOST_AUTO_TEST_CASE(relative_differences_are_percent_unless_small) {
  BOOST_TEST(percent_text(0.2611, 3, true) == "+26.1\u202f%");
  BOOST_TEST(percent_text(-0.2, 3, true) == "\u221220\u202f%");
  BOOST_TEST(percent_text(2.1e-9, 3, true) == "+2.1\u202f×\u202f10⁻⁹");
  BOOST_TEST(percent_text(0, 3, true) == "0");
}

BOOST_AUTO_TEST_CASE(shown_digits_distinguish_two_numbers) {
  const double target = 3.5160152685, computed = 3.5160179;
  const int digits = distinguishing_digits(target, computed);
  BOOST_TEST(rounded_text(target, digits) != rounded_text(computed, digits));
  BOOST_TEST(distinguishing_digits(1.0, 2.0) == 4);
  BOOST_TEST(distinguishing_digits(1.0, 1.0 + 1e-15) == 6);
}

BOOST_AUTO_TEST_CASE(shortest_text_reads_back_as_the_same_double) {
  BOOST_TEST(shortest_decimal(0.1) == "0.1");
  for (const double x : {0.1, 1.0 / 3, 0.1 + 0.2, 6.02214076e23, -2.5e-300})
    BOOST_TEST(std::stod(shortest_decimal(x)) == x);
}

BOOST_AUTO_TEST_CASE(durations_have_readable_units) {
  BOOST_TEST(duration(0.00084) == "840 µs");
  BOOST_TEST(duration(0.0123) == "12.3 ms");
  BOOST_TEST(duration(3.44) == "3.44 s");
  BOOST_TEST(duration(125) == "2 min 5 s");
}

BOOST_AUTO_TEST_CASE(numbers_within_a_text_get_powers_of_ten) {
  BOOST_TEST(with_powers_of_ten("1e-6 takes 'fine'") == "10⁻⁶ takes 'fine'");
  BOOST_TEST(with_powers_of_ten("off by 2.1e-09.") == "off by 2.1\u202f×\u202f10⁻⁹.");
  for (const char* same : {"", "0.01 % of 3", "information", "v1e6", "3e5a", "1.e", "x_1e-6"})
    BOOST_TEST(with_powers_of_ten(same) == same);
}

BOOST_AUTO_TEST_SUITE_END()
