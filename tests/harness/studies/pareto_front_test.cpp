#include "harness/studies/pareto_front.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(pareto_front)

using namespace trammel;
using namespace trammel::testing;

namespace {

std::vector<std::size_t> indices(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> out;
  for (const CostPoint& point : points) out.push_back(point.setting);
  return out;
}

const std::vector<std::string> titles = {"coarse", "wasteful", "middle", "fine", "finest"};

/// Returns errors and times of five settings. Setting 2 dominates setting 1.
std::vector<CostPoint> sample() {
  return {{0, 0.02, 1}, {1, 0.02, 5}, {2, 5e-3, 2}, {3, 1e-4, 4}, {4, 1e-7, 16}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(dominated_setting_is_not_on_the_pareto_front) {
  const std::vector<std::size_t> expected = {0, 2, 3, 4};
  std::vector<CostPoint> points = sample();
  BOOST_TEST(indices(find_pareto_front(points)) == expected, boost::test_tools::per_element());
  std::reverse(points.begin(), points.end());
  BOOST_TEST(indices(find_pareto_front(points)) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(differences_within_timing_scatter_keep_the_front) {
  // Settings 0 and 1 have the same error. Setting 1 is 3 % faster or slower than setting 0, which
  // is within the scatter of measured times.
  for (const double noise : {0.97, 1.03}) {
    const std::vector<CostPoint> points = {{0, 1e-3, 1}, {1, 1.0000001e-3, noise}, {2, 1e-5, 3}};
    const std::vector<std::size_t> expected = {0, 2};
    BOOST_TEST(indices(find_pareto_front(points)) == expected, boost::test_tools::per_element());
    BOOST_TEST(fastest_allowed(points, 0.01)->setting == 0U);
  }
}

BOOST_AUTO_TEST_CASE(most_accurate_of_equally_fast_settings_is_cheapest) {
  const std::vector<CostPoint> points = {{0, 8e-3, 1}, {1, 1e-4, 1.04}};
  BOOST_TEST(fastest_allowed(points, 0.01)->setting == 1U);
}

BOOST_AUTO_TEST_CASE(cheapest_setting_is_within_the_permitted_error) {
  BOOST_TEST(fastest_allowed(sample(), 0.05)->setting == 0U);
  BOOST_TEST(fastest_allowed(sample(), 0.01)->setting == 2U);
  BOOST_TEST(fastest_allowed(sample(), 1e-3)->setting == 3U);
  BOOST_TEST(fastest_allowed(sample(), 1e-6)->setting == 4U);
  BOOST_TEST(!fastest_allowed(sample(), 1e-9).has_value());
}

BOOST_AUTO_TEST_CASE(conclusion_names_cheapest_and_finest_settings) {
  const std::string words = describe_pareto_front(sample(), titles, 0);
  BOOST_TEST(contains(words, "'middle' is the fastest setting, taking 2 times as long as"));
  BOOST_TEST(contains(words, "requires 'finest', which takes 8 times as long"));
}

BOOST_AUTO_TEST_CASE(conclusion_names_all_settings_tied_with_the_cheapest) {
  std::vector<CostPoint> points = {{0, 5e-3, 1, 0.9, 1.3}, {2, 4e-3, 1.4, 1.2, 1.5}, {3, 1e-3, 2}};
  BOOST_TEST(contains(describe_pareto_front(points, titles, 0),
                      "'coarse' or 'middle' is the fastest setting (their times"));
  points[1].low = 1.4;
  BOOST_TEST(contains(describe_pareto_front(points, titles, 0), "the fastest setting;"));
}

BOOST_AUTO_TEST_CASE(conclusion_never_compares_the_baseline_with_itself) {
  BOOST_TEST(contains(describe_pareto_front({{0, 1e-3, 1}}, titles, 0), "the fastest setting;"));
  BOOST_TEST(contains(describe_pareto_front({{1, 1e-3, 1.02}}, titles, 0), "as long as 'coarse'"));
}

BOOST_AUTO_TEST_CASE(conclusion_has_no_more_digits_than_measured) {
  const std::string words = describe_pareto_front({{0, 1e-3, 1}, {4, 1e-7, 7917.3}}, titles, 0);
  BOOST_TEST(contains(words, "which takes 7900 times as long"));
}

BOOST_AUTO_TEST_CASE(conclusion_names_unreached_accuracies) {
  std::vector<CostPoint> points = sample();
  points.pop_back();
  BOOST_TEST(contains(describe_pareto_front(points, titles, 0),
                      "the smallest error is that of 'fine', 0.01 %"));
  points = {{0, 0.02, 1}};
  BOOST_TEST(contains(describe_pareto_front(points, titles, 0), "All errors exceed 1 %"));
  BOOST_TEST(contains(describe_pareto_front({}, titles, 0), "No setting could be measured"));
  points = {{4, 1e-7, 16}};
  BOOST_TEST(contains(describe_pareto_front(points, titles, 0), "at most 1e-6 as well"));
}

BOOST_AUTO_TEST_CASE(difference_of_pareto_fronts_is_relative_time_change) {
  BOOST_TEST(compare_pareto_fronts(sample(), sample()) == 0);
  std::vector<CostPoint> slower = sample();
  slower[3].time *= 1.2;
  BOOST_TEST(compare_pareto_fronts(sample(), slower) == 0.2, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
