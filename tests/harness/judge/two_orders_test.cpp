// Convergence studies of three kinds of series: the error has terms of two orders, an order other
// than the theoretical order, or no order.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "harness/judge/convergence.h"

BOOST_AUTO_TEST_SUITE(two_orders)

using namespace trammel::harness;

namespace {

Convergence series_of_function(const std::function<double(double)>& value, std::size_t levels,
                               double roundoff = 1e-16) {
  Convergence series;
  for (std::size_t k = 0; k < levels; ++k) {
    const double h = std::exp2(-static_cast<double>(k));
    series.parameter.push_back(1 / h);
    series.size.push_back(h);
    series.values.push_back(value(h));
    series.roundoff.push_back(roundoff);
  }
  return series;
}

/// Returns the series of values 10 (1 + a h^4 + b h^2) for successively halved h.
Convergence mixed(double a, double b, std::size_t levels) {
  Convergence series = series_of_function(
      [=](double h) { return 10 * (1 + a * std::pow(h, 4) + b * h * h); }, levels);
  series.exact = 10;
  series.theory_order = 4;
  return series;
}

}  // namespace

BOOST_AUTO_TEST_CASE(mixture_of_two_orders_is_fitted_and_extrapolated) {
  Convergence series = mixed(0.5, 2e-3, 7);
  series.lower_order = 2;
  const Convergence found = analyze_convergence(series);
  BOOST_REQUIRE(found.two_term.has_value());
  BOOST_TEST(*found.two_term->coefficients[0] == 0.5, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*found.two_term->coefficients[1] == 2e-3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*found.two_term->max_relative_misfit < 1e-9);
  BOOST_TEST(std::abs(found.richardson.value() - 10) < 1e-12);
  for (std::size_t k = 0; k < 7; ++k) BOOST_TEST(found.in_asymptotic_range[k]);
}

BOOST_AUTO_TEST_CASE(gci_of_two_known_orders_holds_with_factor_1_25) {
  Convergence series = mixed(0.5, 2e-3, 8);
  series.lower_order = 2;
  const Convergence found = analyze_convergence(series);
  for (std::size_t k = 2; k < 8; ++k) {
    BOOST_TEST(*found.safety_factor[k] == 1.25);
    BOOST_TEST(*found.gci[k] >= *found.error[k]);
    BOOST_TEST(*found.gci[k] < 1.3 * *found.error[k]);
  }
}

BOOST_AUTO_TEST_CASE(gci_with_unknown_second_order_has_factor_3) {
  const Convergence found = analyze_convergence(mixed(0.5, 2e-3, 8));
  bool large = false;
  for (std::size_t k = 2; k < 8; ++k) {
    large = large || *found.safety_factor[k] == 3;
    if (*found.safety_factor[k] == 3) BOOST_TEST(*found.gci[k] >= *found.error[k]);
  }
  BOOST_TEST(large);
}

BOOST_AUTO_TEST_CASE(linear_error_does_not_fit_orders_four_and_two) {
  Convergence series = series_of_function([](double h) { return 10 * (1 + 0.1 * h); }, 7);
  series.exact = 10;
  series.theory_order = 4;
  series.lower_order = 2;
  const Convergence found = analyze_convergence(series);
  BOOST_REQUIRE(found.two_term.has_value());
  BOOST_TEST(*found.two_term->max_relative_misfit > kTwoTermTolerance);
  for (std::size_t k = 0; k < 7; ++k) BOOST_TEST(!found.in_asymptotic_range[k]);
  for (std::size_t k = 2; k < 7; ++k) BOOST_TEST(*found.safety_factor[k] == 3);
}

BOOST_AUTO_TEST_CASE(gci_of_two_levels_has_theoretical_order_and_factor_3) {
  Convergence series = series_of_function([](double h) { return 10 * (1 + 0.1 * h * h); }, 2);
  series.theory_order = 2;
  const Convergence found = analyze_convergence(series);
  BOOST_TEST(*found.safety_factor[1] == 3);
  // With the values v0 at h and v1 at h/2, order 2 and safety factor 3, the GCI times v1 is 3 |v1 -
  // v0| / (2^2 - 1) = |v1 - v0|.
  BOOST_TEST(*found.gci[1] * *series.values[1] == *series.values[0] - *series.values[1],
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(nonmonotone_values_converge_on_fine_levels) {
  // h^2 - 1.3 h^3 first falls and then rises, so the values on coarse levels are not monotone.
  Convergence series =
      series_of_function([](double h) { return 10 * (1 + 0.1 * h * h - 0.13 * h * h * h); }, 10);
  series.exact = 10;
  series.theory_order = 2;
  const Convergence found = analyze_convergence(series);
  BOOST_TEST(*found.safety_factor[2] == 3);
  BOOST_TEST(*found.safety_factor[9] == 1.25);
  BOOST_TEST(std::abs(found.fitted_order.value() - 2) < 0.1);
  for (std::size_t k = 2; k < 10; ++k) BOOST_TEST(*found.gci[k] >= *found.error[k]);
}

BOOST_AUTO_TEST_CASE(values_that_are_errors_have_the_exact_value_zero) {
  Convergence series = series_of_function([](double h) { return 0.3 * h * h; }, 6);
  series.exact = 0;
  series.is_error = true;
  series.theory_order = 2;
  const Convergence found = analyze_convergence(series);
  for (std::size_t k = 0; k < 6; ++k) BOOST_TEST(*found.error[k] == *series.values[k]);
  BOOST_TEST(std::abs(found.fitted_order.value() - 2) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
