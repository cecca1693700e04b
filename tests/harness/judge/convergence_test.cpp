#include "harness/judge/convergence.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(convergence)

using namespace trammel::harness;

namespace {

/// Returns the series v(h) = 10 (1 + a h^p + b h^(p+2)) for h = 1, 1/2, ... with alternating
/// round-off.
Convergence power_law(double p, double a, double b, std::size_t levels, double roundoff = 1e-15) {
  Convergence series;
  series.theory_order = p;
  for (std::size_t k = 0; k < levels; ++k) {
    const double h = std::exp2(-static_cast<double>(k)), noise = roundoff * (k % 2 == 0 ? 1 : -1);
    series.parameter.push_back(1 / h);
    series.size.push_back(h);
    series.values.push_back(10 * (1 + a * std::pow(h, p) + b * std::pow(h, p + 2) + noise));
    series.roundoff.push_back(roundoff);
  }
  return series;
}

}  // namespace

BOOST_AUTO_TEST_CASE(order_of_a_power_law_is_its_exponent) {
  for (const double p : {1.0, 2.0, 4.0}) {
    Convergence series = power_law(p, 0.1, 0, 6);
    for (const bool known : {false, true}) {
      if (known) series.exact = 10;
      const Convergence found = analyze_convergence(series);
      BOOST_TEST(std::abs(found.fitted_order.value() - p) < 1e-3);
      BOOST_TEST(std::abs(found.richardson.value() - 10) < 1e-12);
      for (std::size_t k = 2; k < 5; ++k) BOOST_TEST(std::abs(*found.order[k] - p) < 1e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(order_is_found_for_any_refinement_ratio) {
  Convergence series;
  for (const double n : {4.0, 5.0, 7.0, 12.0}) {
    series.parameter.push_back(n);
    series.size.push_back(1 / n);
    series.values.push_back(3 + 2 * std::pow(n, -2.5));
    series.roundoff.push_back(1e-15);
  }
  const Convergence found = analyze_convergence(series);
  BOOST_TEST(std::abs(*found.order[2] - 2.5) < 1e-6);
  BOOST_TEST(std::abs(*found.order[3] - 2.5) < 1e-6);
  BOOST_TEST(std::abs(found.richardson.value() - 3) < 1e-9);
}

/// Returns a series of values for h = 1, 1/2, 1/4, ...
Convergence make_series(const std::vector<double>& values) {
  Convergence series = power_law(2, 0, 0, values.size());
  series.values = {values.begin(), values.end()};
  return series;
}

BOOST_AUTO_TEST_CASE(values_that_diverge_are_not_extrapolated) {
  // The values of each series do not converge: they grow like log h or 1/h, or oscillate.
  for (const auto& values : {std::vector<double>{1, 2, 3, 4, 5}, {1, 2, 4, 8, 16}, {1, 2, 0, 4}})
    for (const bool known : {false, true}) {
      Convergence series = make_series(values);
      if (!known) series.theory_order.reset();
      const Convergence found = analyze_convergence(series);
      BOOST_TEST(!found.richardson.has_value());
      for (std::size_t k = 2; k < values.size(); ++k) {
        BOOST_TEST(std::isnan(*found.gci[k]));
        BOOST_TEST(!found.at_roundoff_floor[k]);
      }
    }
}

BOOST_AUTO_TEST_CASE(divergence_on_coarse_meshes_is_ignored) {
  const Convergence found = analyze_convergence(make_series({1, 2, 6, 7, 7.25, 7.3125}));
  BOOST_TEST(std::isnan(*found.gci[2]));
  BOOST_TEST(std::abs(found.richardson.value() - 7.3333333333333333) < 1e-12);
  const Convergence last = analyze_convergence(make_series({1, 2, 6, 7}));
  BOOST_TEST(std::abs(last.richardson.value() - 7.3333333333333333) < 1e-12);
}

BOOST_AUTO_TEST_CASE(slow_convergence_and_round_off_are_no_divergence) {
  const Convergence slow = analyze_convergence(make_series({4, 3, 2.1, 1.29}));  // slow: order 0.15
  BOOST_TEST(std::isfinite(*slow.gci[3]));
  BOOST_TEST(slow.richardson.has_value());
  const Convergence noise = analyze_convergence(make_series({3, 3 + 1e-15, 3 - 2e-15, 3 + 8e-15}));
  BOOST_TEST(noise.richardson.value() == 3, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(std::isfinite(*noise.gci[3]));
}

BOOST_AUTO_TEST_CASE(second_error_term_limits_the_asymptotic_range) {
  Convergence series = power_law(4, 0.1, 0.5, 8);
  series.exact = 10;
  const Convergence found = analyze_convergence(series);
  BOOST_TEST(!found.in_asymptotic_range[1]);
  BOOST_TEST(found.in_asymptotic_range[4]);
  BOOST_TEST(found.in_asymptotic_range[5]);
}

BOOST_AUTO_TEST_CASE(round_off_floor_is_recognized) {
  Convergence series = power_law(4, 0.1, 0, 12, 1e-12);
  series.exact = 10;
  const Convergence found = analyze_convergence(series);
  // The error 0.1 h^4 exceeds the round-off floor 100e-12 for h > 1/178.
  for (std::size_t k = 0; k < 12; ++k) BOOST_TEST(found.at_roundoff_floor[k] == (k >= 8));
  for (std::size_t k = 8; k < 12; ++k) BOOST_TEST(!found.in_asymptotic_range[k]);
  BOOST_TEST(std::abs(found.fitted_order.value() - 4) < 0.01);
  BOOST_TEST(std::abs(found.richardson.value() - 10) < 1e-10);
}

BOOST_AUTO_TEST_CASE(error_band_contains_the_exact_value_and_is_narrow) {
  for (const double b : {0.5, -0.03, 0.0}) {
    const Convergence series = power_law(4, 0.1, b, 12, 1e-14);
    const Convergence found = analyze_convergence(series);
    for (std::size_t k = 1; k < 12; ++k) {
      const double error = std::abs(*series.values[k] - 10) / std::abs(*series.values[k]);
      BOOST_TEST(*found.gci[k] >= error);
      if (k > 4 && !found.at_roundoff_floor[k]) {
        BOOST_TEST(*found.safety_factor[k] == 1.25);
        BOOST_TEST(*found.gci[k] < 1.4 * error);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(order_other_than_theory_has_safety_factor_3) {
  Convergence series = power_law(2, 0.1, 0, 6);
  series.theory_order = 4;
  const Convergence found = analyze_convergence(series);
  for (std::size_t k = 2; k < 6; ++k) BOOST_TEST(*found.safety_factor[k] == 3);
  series.theory_order.reset();
  BOOST_TEST(*analyze_convergence(series).safety_factor[5] == 3);  // theoretical order unknown
}

BOOST_AUTO_TEST_CASE(oscillating_values_have_no_order) {
  Convergence series = power_law(2, 0.1, 0, 5);
  for (std::size_t k = 0; k < 5; ++k) series.values[k] = k % 2 == 0 ? 1.0 : 2.0;
  const Convergence found = analyze_convergence(series);
  for (const auto order : found.order) BOOST_TEST(std::isnan(*order));
  BOOST_TEST(!found.fitted_order.has_value());
}

BOOST_AUTO_TEST_CASE(missing_levels_are_skipped_at_the_coarse_end_only) {
  Convergence series = power_law(4, 0.1, 0, 7);
  series.exact = 10;
  series.values[0] = std::nan("");
  Convergence found = analyze_convergence(series);
  BOOST_TEST(!found.broken);
  BOOST_TEST(std::isnan(*found.error[0]));
  BOOST_TEST(std::abs(*found.order[2] - 4) < 1e-3);
  series.values[5] = std::nan("");
  found = analyze_convergence(series);
  BOOST_TEST(found.broken);
}

BOOST_AUTO_TEST_CASE(too_few_levels_have_no_order) {
  const Convergence found = analyze_convergence(power_law(4, 0.1, 0, 1));
  BOOST_TEST(!found.richardson.has_value());
  BOOST_TEST(!found.fitted_order.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
