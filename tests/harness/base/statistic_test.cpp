#include "harness/base/statistic.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(statistic)

using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(nan_or_missing_value_is_an_infinite_difference) {
  const auto one = [](std::size_t) { return 1.0; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LargestDifference plain = largest_difference({1, 2, 5}, {1, 4, 4}, one);
  BOOST_TEST(plain.value == 2);
  BOOST_TEST(plain.index == 1U);
  BOOST_TEST(std::isinf(largest_difference({1, 2}, {1, nan}, one).value));
  BOOST_TEST(std::isinf(largest_difference({nan, 2}, {1, 2}, one).value));
  BOOST_TEST(std::isinf(largest_difference({1, 2}, {1}, one).value));
  BOOST_TEST(std::isinf(largest_difference({1}, {2}, [](std::size_t) { return 0.0; }).value));
}

BOOST_AUTO_TEST_CASE(statistic_of_no_or_missing_numbers_is_nan) {
  BOOST_TEST(statistic_of("median", {4, 1, 3, 2}) == 2.5);
  BOOST_TEST(std::isnan(statistic_of("max", {1, std::nan(""), 3})));
  BOOST_TEST(std::isnan(statistic_of("mean", {})));
}

BOOST_AUTO_TEST_SUITE_END()
