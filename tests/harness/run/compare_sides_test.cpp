#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/run/diff.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(compare_sides)

using namespace trammel;
using namespace trammel::testing;

namespace {

/// Returns a result set ("side") of a comparison: results with one run that has these quantities.
Side side(const std::string& label, const std::map<std::string, std::vector<double>>& quantities) {
  Side made{label, {}, std::nullopt};
  made.results.cases.emplace_back();
  made.results.cases.front().id = "a";
  results::Run run;
  run.case_id = "a";
  run.variant = "base";
  run.status = results::Status::solved;
  for (const auto& [name, values] : quantities) run.quantities[name].values = values;
  made.results.runs.push_back(std::move(run));
  return made;
}

results::SideComparison compare_pair(const Side& a, const Side& b) {
  return harness::compare_sides({a, b}, false);
}

/// Returns a result set of a comparison with mode shapes of two nodes that move along y only.
Side drawn(const std::string& label, const std::vector<double>& frequencies,
           const std::vector<std::pair<double, double>>& shapes) {
  Side made = side(label, {{"frequency_Hz", frequencies}});
  results::Drawing drawing;
  drawing.nodes = {{0, 0}, {1, 0}};
  for (const auto& [first, second] : shapes)
    drawing.shapes.push_back({"mode", {{0, first}, {0, second}}});
  made.results.runs.front().drawing = drawing;
  return made;
}

/// Returns a check that compares mass_kg with 1 kg.
results::Check mass_check() {
  results::Check check;
  check.name = "c";
  check.quantity = "mass_kg";
  check.measure = "relative";
  check.expected = 1;
  check.tolerance = results::Tolerance{-1, 1, true};
  return check;
}

}  // namespace

BOOST_AUTO_TEST_CASE(change_in_any_of_three_results_is_counted) {
  const Side a = side("a", {{"mass_kg", {1.0}}}), b = side("b", {{"mass_kg", {2.0}}}),
             c = side("c", {{"mass_kg", {1.0}}});
  BOOST_TEST(harness::compare_sides({a, b, c}, false).changed == 1U);
  BOOST_TEST(harness::compare_sides({a, c, b}, false).changed == 1U);
}

BOOST_AUTO_TEST_CASE(difference_within_roundoff_of_refinement_is_no_change) {
  Side a = side("a", {{"mass_kg", {1.0, 2.0}}}), b = side("b", {{"mass_kg", {1.0, 2 + 1e-8}}});
  results::Convergence study;
  study.quantity = "mass_kg";
  study.index = 1;
  study.roundoff = {1e-9, 1e-8};
  b.results.runs[0].convergence = {study};
  BOOST_TEST(compare_pair(a, b).changed == 0U);
  // A relative change above 1e-6 is not round-off, even if the convergence study of the run
  // estimates 1e-3 as round-off.
  b.results.runs[0].convergence[0].roundoff = {1e-3, 1e-3};
  BOOST_TEST(compare_pair(a, b).changed == 1U);
  b.results.runs[0].convergence = {study};
  b.results.runs[0].quantities["mass_kg"].values = {1.0, std::nan("")};
  BOOST_TEST(compare_pair(a, b).changed == 1U);
}

BOOST_AUTO_TEST_CASE(round_off_of_a_zero_is_no_change_and_has_no_percent) {
  const Side a = side("a", {{"force_N:A", {1e-13}}, {"force_N:B", {100.0}}});
  const Side b = side("b", {{"force_N:A", {-3e-12}}, {"force_N:B", {101.0}}});
  const results::SideComparison found = compare_pair(a, b);
  for (const results::ComparedNumber& number : found.runs.at(0).numbers) {
    const bool zero = number.quantity == "force_N:A";
    BOOST_TEST(number.changed == !zero);
    BOOST_TEST(number.percent[1].has_value() == !zero);
  }
  BOOST_TEST(contains(found.conclusion, "force_N:B by +1 % (100 to 101 N)"), found.conclusion);
}

BOOST_AUTO_TEST_CASE(numbers_without_a_unit_have_no_common_scale) {
  const Side a = side("a", {{"skill_score", {1.0}}, {"relative_error:y", {1e-12}}});
  const Side b = side("b", {{"skill_score", {1.0}}, {"relative_error:y", {2e-12}}});
  BOOST_TEST(compare_pair(a, b).changed == 1U);
}

BOOST_AUTO_TEST_CASE(modes_are_matched_by_their_drawn_shapes) {
  const Side a = drawn("a", {10, 20}, {{1, 1}, {1, -1}});
  const results::SideComparison found = compare_pair(a, drawn("b", {12, 20}, {{1, -1}, {1, 1}}));
  const auto& modes = found.runs.at(0).modes;
  BOOST_REQUIRE(modes.size() == 2U);
  BOOST_TEST(modes[0].modes[1].front() == 2U);
  BOOST_TEST(*modes[0].percent[1] == 100, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*modes[1].percent[1] == -40, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(equal_frequencies_are_matched_as_one_set) {
  const double s = std::sqrt(0.5);
  const Side a = drawn("a", {10, 10}, {{1, 0}, {0, 1}});
  const results::SideComparison found = compare_pair(a, drawn("b", {11, 11}, {{s, s}, {s, -s}}));
  const auto& modes = found.runs.at(0).modes;
  BOOST_REQUIRE(modes.size() == 1U);
  for (std::vector<std::size_t> set : modes[0].modes) {
    std::ranges::sort(set);
    BOOST_TEST(set == (std::vector<std::size_t>{1, 2}), boost::test_tools::per_element());
  }
  BOOST_TEST(*modes[0].alike[1] == 1, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(missing_run_and_other_verdict_are_changes) {
  Side a = side("a", {{"mass_kg", {1.0}}}), b = a;
  b.label = "b";
  BOOST_TEST(compare_pair(a, b).same == 1U);
  a.results.runs[0].checks = {mass_check()};
  b.results.runs[0].checks = a.results.runs[0].checks;
  a.results.runs[0].checks[0].verdict = results::Verdict::pass;
  const results::SideComparison verdict = compare_pair(a, b);
  BOOST_TEST(verdict.changed == 1U);
  BOOST_TEST(contains(verdict.conclusion, "check c: error in b, pass in a"), verdict.conclusion);
  b.results.runs[0].variant = "other";
  const results::SideComparison found = compare_pair(a, b);
  BOOST_TEST(found.changed == 2U);
  BOOST_TEST(found.runs.at(0).remarks.at(0) == "missing from b");
}

namespace {

/// Returns a result set with checks of one value each, whose errors are `error` times a factor.
Side side_with_errors(const std::string& label, double error, const std::vector<double>& factors) {
  Side made = side(label, {{"mass_kg", {1.0}}});
  for (const double factor : factors) {
    results::Check check = mass_check();
    check.index = static_cast<int>(made.results.runs[0].checks.size());
    check.reference = "printed";
    check.computed = 1 + error * factor;
    made.results.runs[0].checks.push_back(check);
  }
  return made;
}

}  // namespace

BOOST_AUTO_TEST_CASE(compared_results_have_errors_against_references) {
  const auto found = compare_pair(side_with_errors("coarse", 0.3, {1, 1, 1.2}),
                                  side_with_errors("fine", 0.1, {1, 1, 50}));
  BOOST_TEST(*found.sides[0].median_error == 0.3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*found.sides[0].largest_error == 0.36, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*found.sides[1].largest_error == 5, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
