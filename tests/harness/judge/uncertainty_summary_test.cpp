#include "harness/judge/uncertainty_summary.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

using namespace trammel;

namespace {

/// A study of values 10 (1 + a h^p) on `levels` halvings, whose bands are then scaled.
Convergence made_up(std::size_t levels, double scale) {
  Series series;
  series.theory = 2;
  series.exact = 10;
  for (std::size_t k = 0; k < levels; ++k) {
    const double h = std::exp2(-static_cast<double>(k));
    series.parameter.push_back(1 / h);
    series.size.push_back(h);
    series.values.push_back(10 * (1 + 0.1 * h * h));
    series.roundoff.push_back(1e-16);
  }
  Convergence found = study(series);
  for (double& band : found.band) band *= scale;
  return found;
}

BandSummary summarise(const std::vector<Convergence>& all) {
  std::vector<const Convergence*> pointers;
  for (const Convergence& one : all) pointers.push_back(&one);
  return summarise_bands(pointers);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(uncertainty_summary)

BOOST_AUTO_TEST_CASE(bands_of_a_clean_series_hold_and_are_a_quarter_too_wide) {
  const BandSummary bands = summarise(std::vector<Convergence>(30, made_up(8, 1)));
  BOOST_TEST(bands.levels == 30U * 7U);  // the first level has no band
  BOOST_TEST(bands.hit_rate() == 1.0);
  BOOST_TEST(bands.median_ratio == 1.25, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(!bands.fails());
}

BOOST_AUTO_TEST_CASE(bands_that_miss_too_often_fail) {
  std::vector<Convergence> all(30, made_up(8, 1));
  for (std::size_t i = 0; i < 3; ++i) all[i] = made_up(8, 0.5);
  const BandSummary bands = summarise(all);
  BOOST_TEST(bands.hits < bands.levels);
  BOOST_TEST(bands.fails());
}

BOOST_AUTO_TEST_CASE(bands_that_are_huge_fail_although_they_never_miss) {
  const BandSummary bands = summarise(std::vector<Convergence>(30, made_up(8, 4)));
  BOOST_TEST(bands.hit_rate() == 1.0);
  BOOST_TEST(bands.fails());
}

BOOST_AUTO_TEST_CASE(a_few_levels_decide_nothing) {
  const BandSummary bands = summarise({made_up(8, 0.5)});
  BOOST_TEST(bands.hit_rate() < 0.95);
  BOOST_TEST(!bands.fails());
}

BOOST_AUTO_TEST_CASE(series_without_an_exact_value_do_not_count) {
  Convergence found = made_up(8, 1);
  found.series.exact.reset();
  const BandSummary bands = summarise({found});
  BOOST_TEST(bands.levels == 0U);
  BOOST_TEST(std::isnan(bands.hit_rate()));
  BOOST_TEST(!bands.fails());
}

BOOST_AUTO_TEST_CASE(a_ratio_that_is_not_a_number_fails_closed) {
  BandSummary bands;
  bands.levels = bands.hits = 1000;
  bands.median_ratio = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(bands.fails());
}

BOOST_AUTO_TEST_SUITE_END()
