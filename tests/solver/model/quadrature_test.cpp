#include "solver/model/quadrature.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(quadrature)

namespace t = trammel::solver;

namespace {

double integral_of_power(int power) {
  double sum = 0;
  for (const auto& point : t::line_quadrature()) sum += point.weight * std::pow(point.xi, power);
  return sum;
}

/// Returns the mean of L_0^a L_1^b L_2^c over a triangle: 2 a! b! c! / (a + b + c + 2)!.
double exact_mean_over_triangle(int a, int b, int c) {
  return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) /
         std::tgamma(a + b + c + 3);
}

double mean(int a, int b, int c) {
  double sum = 0;
  for (const auto& point : t::triangle_quadrature()) {
    sum += point.weight * std::pow(point.area_coordinates[0], a) *
           std::pow(point.area_coordinates[1], b) * std::pow(point.area_coordinates[2], c);
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(line_quadrature_rule_is_exact_to_degree_9) {
  for (int power = 0; power <= 9; ++power)
    BOOST_TEST(integral_of_power(power) == 1.0 / (power + 1), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(std::abs(integral_of_power(10) - 1.0 / 11) > 1e-7);
}

BOOST_AUTO_TEST_CASE(triangle_quadrature_rule_is_exact_to_degree_8) {
  for (int degree = 0; degree <= 8; ++degree)
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b) {
        BOOST_TEST(mean(a, b, degree - a - b) == exact_mean_over_triangle(a, b, degree - a - b),
                   boost::test_tools::tolerance(1e-13));
      }
  BOOST_TEST(std::abs(mean(10, 0, 0) / exact_mean_over_triangle(10, 0, 0) - 1) > 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
