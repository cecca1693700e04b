
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/judge/convergence.h"

BOOST_AUTO_TEST_SUITE(uncertainty_summary)

using namespace trammel;
using namespace trammel::harness;

namespace {

/// Returns a convergence study of 10 (1 + 0.1 h^2) for h = 1, 1/2, 1/4, ..., whose GCI values are
/// multiplied by `scale`.
Convergence synthetic_study(std::size_t levels, double scale) {
  Convergence series;
  series.theory_order = 2;
  series.exact = 10;
  for (std::size_t k = 0; k < levels; ++k) {
    const double h = std::exp2(-static_cast<double>(k));
    series.parameter.push_back(1 / h);
    series.size.push_back(h);
    series.values.push_back(10 * (1 + 0.1 * h * h));
    series.roundoff.push_back(1e-16);
  }
  Convergence found = analyze_convergence(series);
  for (results::Number& band : found.gci) band = *band * scale;
  return found;
}

results::UncertaintyCoverage find_coverage(const std::vector<Convergence>& all) {
  results::Run run;
  run.convergence = all;
  return summarize_numerical_uncertainty({run});
}

}  // namespace

BOOST_AUTO_TEST_CASE(gci_of_an_exact_power_law_is_1_25_times_the_error) {
  const results::UncertaintyCoverage summary =
      find_coverage(std::vector<Convergence>(30, synthetic_study(8, 1)));
  BOOST_TEST(summary.levels == 30U * 7U);  // the first level has no GCI
  BOOST_TEST(*summary.coverage == 1.0);
  BOOST_TEST(*summary.median_ratio == 1.25, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(summary.passes);
}

BOOST_AUTO_TEST_CASE(error_bands_exceeded_by_too_many_errors_fail) {
  std::vector<Convergence> all(30, synthetic_study(8, 1));
  for (std::size_t i = 0; i < 3; ++i) all[i] = synthetic_study(8, 0.5);
  const results::UncertaintyCoverage summary = find_coverage(all);
  BOOST_TEST(summary.covered < summary.levels);
  BOOST_TEST(!summary.passes);
}

BOOST_AUTO_TEST_CASE(too_wide_error_bands_fail_although_they_hold) {
  const results::UncertaintyCoverage summary =
      find_coverage(std::vector<Convergence>(30, synthetic_study(8, 4)));
  BOOST_TEST(*summary.coverage == 1.0);
  BOOST_TEST(!summary.passes);
}

BOOST_AUTO_TEST_CASE(band_is_relative_to_value_and_error_to_exact_value) {
  Convergence found = synthetic_study(3, 1);
  found.values = {10, 10, 15};
  found.error = {0, 0, 0.5};
  found.gci = {NAN, NAN, 0.4};  // at the last level: absolute uncertainty 6, error 5
  BOOST_TEST(find_coverage({found}).levels == 1U);
  BOOST_TEST(find_coverage({found}).covered == 1U);
  found.gci[2] = 0.3;
  BOOST_TEST(find_coverage({found}).covered == 0U);
}

BOOST_AUTO_TEST_CASE(too_few_levels_do_not_fail_the_error_coverage) {
  const results::UncertaintyCoverage summary = find_coverage({synthetic_study(8, 0.5)});
  BOOST_TEST(*summary.coverage < 0.95);
  BOOST_TEST(summary.passes);
}

BOOST_AUTO_TEST_CASE(series_without_an_exact_value_do_not_count) {
  Convergence found = synthetic_study(8, 1);
  found.exact.reset();
  const results::UncertaintyCoverage summary = find_coverage({found});
  BOOST_TEST(summary.levels == 0U);
  BOOST_TEST(!summary.coverage.has_value());
  BOOST_TEST(summary.passes);
}

BOOST_AUTO_TEST_CASE(coverage_of_levels_at_roundoff_floor_only_fails) {
  Convergence found = synthetic_study(8, 1);
  found.at_roundoff_floor.assign(8, true);  // excludes every level from the ratio of GCI to error
  const results::UncertaintyCoverage summary = find_coverage(std::vector<Convergence>(30, found));
  BOOST_TEST(*summary.coverage == 1.0);
  BOOST_TEST(!summary.passes);
}

BOOST_AUTO_TEST_SUITE_END()
