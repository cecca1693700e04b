#include "solver/model/numbers.h"

#include <boost/test/unit_test.hpp>
#include <limits>

BOOST_AUTO_TEST_SUITE(numbers)

using namespace trammel::solver;

BOOST_AUTO_TEST_CASE(maximum_propagates_nan) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  BOOST_TEST(nan_max(1, 2) == 2);
  BOOST_TEST(nan_max(2, 1) == 2);
  BOOST_TEST(nan_max(-1, -2) == -1);
  BOOST_TEST(nan_max(1, infinite) == infinite);
  for (const double x : {-1.0, 0.0, 1.0, infinite}) {
    BOOST_TEST(std::isnan(nan_max(nothing, x)));
    BOOST_TEST(std::isnan(nan_max(x, nothing)));
  }
}

BOOST_AUTO_TEST_SUITE_END()
