#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/judge/convergence.h"

BOOST_AUTO_TEST_SUITE(two_term)

using namespace trammel;
using namespace trammel::harness;

namespace {

const std::vector<double> kSizes = {1, 0.5, 0.25, 0.125, 0.0625};

std::vector<double> errors(double a, double b, double c = 0) {
  std::vector<double> found;
  for (const double h : kSizes)
    found.push_back(a * std::pow(h, 4) + b * h * h + c * std::pow(h, 6));
  return found;
}

const std::vector<bool> kAll(5, true);

}  // namespace

BOOST_AUTO_TEST_CASE(terms_of_opposite_sign_may_cancel_between_two_levels) {
  const auto fit = fit_two_term_error_law(kSizes, errors(0.3, -0.03), kAll, {4, 2}, 0.05);
  BOOST_REQUIRE(fit.has_value());
  BOOST_TEST(*fit->coefficients[1] == -0.03, boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(coarse_levels_with_a_third_term_are_excluded) {
  const auto fit = fit_two_term_error_law(kSizes, errors(0.3, 2e-3, 0.1), kAll, {4, 2}, 0.01);
  BOOST_REQUIRE(fit.has_value());
  BOOST_TEST(!fit->used[0]);
  BOOST_TEST(fit->used[4]);
  BOOST_TEST(*fit->max_relative_misfit <= 0.01);
  BOOST_TEST(*fit->coefficients[1] == 2e-3, boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(worst_misfit_may_have_either_sign) {
  for (const double factor : {0.5, 2.0}) {  // the error of one level is too small or too large
    std::vector<double> off = errors(0.3, 2e-3);
    off[2] *= factor;
    const auto fit = fit_two_term_error_law(kSizes, off, kAll, {4, 2}, 10);
    BOOST_REQUIRE(fit.has_value());
    double worst = 0;
    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      const double h = kSizes[k];
      const double law = *fit->coefficients[0] * std::pow(h, 4) + *fit->coefficients[1] * h * h;
      worst = std::max(worst, std::abs(law / off[k] - 1));
    }
    BOOST_TEST(*fit->max_relative_misfit == worst, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(levels_at_round_off_are_not_used) {
  std::vector<double> noisy = errors(0.3, 2e-3);
  noisy[4] = 1e-3;
  const auto fit =
      fit_two_term_error_law(kSizes, noisy, {true, true, true, true, false}, {4, 2}, 0.05);
  BOOST_REQUIRE(fit.has_value());
  BOOST_TEST(*fit->coefficients[0] == 0.3, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(two_levels_are_not_enough) {
  BOOST_TEST(!fit_two_term_error_law(kSizes, errors(0.3, 2e-3), {true, true, false, false, false},
                                     {4, 2}, 0.05)
                  .has_value());
}

BOOST_AUTO_TEST_CASE(limit_of_a_two_term_law_needs_three_levels) {
  const auto value = [](double h) { return 7 + 0.3 * std::pow(h, 4) - 0.02 * h * h; };
  const double limit =
      extrapolate_two_term_law({0.5, 0.3, 0.1}, {value(0.5), value(0.3), value(0.1)}, {4, 2});
  BOOST_TEST(limit == 7.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(std::isnan(extrapolate_two_term_law({0.5, 0.5, 0.1}, {1, 1, 2}, {4, 2})));
}

BOOST_AUTO_TEST_SUITE_END()
