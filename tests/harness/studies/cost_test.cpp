#include "harness/studies/cost.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/base/environment.h"
#include "harness/input/document.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(cost)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Returns a cost study of a cantilever's frequencies with mesh refinement. Errors are relative to
/// the frequencies of 16 elements. The second curve requests more modes than its model has.
Json study_json() {
  return Json::parse(R"({
    "id": "arm", "family": "arms", "title": "A cantilever's first frequencies", "case": "cantilever",
    "patch": {"analysis": {"statics": null, "modes": {"count": 2}}},
    "quantities": {"frequency_Hz": {"index": [0, 1]}},
    "reference_solution": {"title": "16 elements", "patch": {"model": {"elements": 16}}},
    "curves": {
      "elements": {"title": "elements", "pointers": ["/model/elements"], "values": [1, 2, 4, 16]},
      "more": {"title": "six modes of one element",
               "patch": {"model": {"elements": 1}, "analysis": {"modes": {"count": 6}}},
               "quantities": {"frequency_Hz": {"index": [6, 7]}}}
    },
    "baseline": {"curve": "elements", "value": 1}
  })");
}

results::CostStudy run_study(const Json& json) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  const References references;
  CostOptions options;
  options.timing.shortest_s = 0;
  return measure_study(load_cost_study(folder.write(json), SweepExtent::full, references), options,
                       references);
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_are_relative_to_the_chosen_scale) {
  const Observations reference_solution = {{10, 0, -5}}, found = {{11, 1, -5}};
  const results::ErrorNorms entry = error_norms(found, reference_solution, {});
  BOOST_TEST(*entry.max == 0.1);  // error 1 at expected value 0, relative to the largest, 10
  BOOST_TEST(*entry.mean == 0.2 / 3);
  BOOST_TEST(*entry.rms == std::sqrt(0.02 / 3));
  const results::ErrorNorms largest =
      error_norms({{10, 0, -4}}, reference_solution, {Scale::Kind::largest, 0});
  BOOST_TEST(*largest.max == 0.1);
  const results::ErrorNorms fixed =
      error_norms({{10, 0, -4}}, reference_solution, {Scale::Kind::number, 4});
  BOOST_TEST(*fixed.max == 0.25);
  // Outputs that are errors, such as relative errors of frequencies, need no reference solution in
  // a cost study.
  BOOST_TEST(*error_norms({{1e-3, -2e-3}}, {{}}, {}).max == 2e-3);
  BOOST_TEST(std::isnan(*error_norms({{1, std::nan(""), 1}}, {{1, 1, 1}}, {}).max));
  BOOST_CHECK_THROW((void)error_norms({{1, 2}}, {{1}}, {}), std::runtime_error);
  BOOST_CHECK_THROW((void)error_norms({{1}}, {{0}}, {}), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(every_setting_is_kept_with_a_status) {
  const results::CostStudy study = run_study(study_json());
  BOOST_TEST_REQUIRE(study.settings.size() == 5U);
  for (std::size_t i : {0U, 1U, 2U}) {
    const results::CostSetting& one = study.settings[i];
    BOOST_TEST((one.status == "measured"));
    BOOST_TEST(one.errors->max.value() > 0);
    BOOST_TEST(one.time->cpu_s.size() == 7U);
  }
  BOOST_TEST(*study.settings[1].errors->max < *study.settings[0].errors->max / 10);
  BOOST_TEST((study.settings[3].status == "reference"));
  BOOST_TEST((study.settings[4].status == "failed"));
  BOOST_TEST(contains(study.settings[4].reason, "values of frequency_Hz"));
  BOOST_TEST(!study.settings[4].time.has_value());
  for (const CostPoint& point : cost_points(study))
    BOOST_TEST((study.settings[point.setting].status == "measured"));
}

BOOST_AUTO_TEST_CASE(outputs_are_judged_separately_and_together) {
  Json json = study_json();
  json["outputs"] = {{"tones", {{"title", "frequencies"}}},
                     {"size", {{"title", "coordinates"}, {"scale", "largest"}}}};
  json["quantities"]["degrees_of_freedom"] = {{"output", "size"}};
  json["curves"]["more"] = {{"title", "lumped"},
                            {"patch", {{"model", {{"elements", 8}}}}},
                            {"quantities", {{"frequency_Hz", {{"index", {0, 1}}}}}}};
  const results::CostStudy study = run_study(json);
  // 16 elements have 48 coordinates, one element has 3.
  BOOST_TEST_REQUIRE(study.settings[0].output_errors.size() == 2U);
  BOOST_TEST(study.settings[0].output_errors[1]->max.value() == 45.0 / 48);
  BOOST_TEST(*study.settings[0].errors->max == *study.settings[0].output_errors[0]->max);
  BOOST_TEST(!study.settings[4].output_errors[1].has_value());
  const std::vector<CostPoint> points = cost_points(study);
  BOOST_TEST(points.size() == 4U);
  const auto all = cost_points(study, std::nullopt), size = cost_points(study, 1);
  BOOST_TEST_REQUIRE(all.size() == 3U);  // excludes the setting without a second output
  for (std::size_t i = 0; i < all.size(); ++i)
    BOOST_TEST(all[i].error == std::max(points[i].error, size[i].error));
  results::CostStudy diverged = study;
  diverged.settings[0].output_errors[1]->max = std::nan("");
  BOOST_TEST(cost_points(diverged, 0).size() == 4U);
  BOOST_TEST(cost_points(diverged, 1).size() == 2U);
  BOOST_TEST(cost_points(diverged, std::nullopt).size() == 2U);
  BOOST_TEST_REQUIRE(study.outputs.size() == 3U);
  BOOST_TEST(study.outputs[1].scale == "relative to the largest of all true values");
  BOOST_TEST(study.outputs[2].title == "all outputs together");
  BOOST_TEST(!study.outputs[2].errors[4].has_value());
  BOOST_TEST(*study.outputs[2].errors[0] == all[0].error);
  BOOST_TEST(study.outputs[0].cheapest[0].setting.has_value());
  BOOST_TEST(!study.outputs[1].cheapest[0].setting.has_value());
}

BOOST_AUTO_TEST_CASE(counters_measure_work_and_are_reproducible) {
  const results::CostStudy a = run_study(study_json()), b = run_study(study_json());
  for (std::size_t i = 0; i < a.settings.size(); ++i)
    BOOST_TEST((a.settings[i].counters == b.settings[i].counters));
  // Twice the number of elements requires twice the number of element evaluations.
  BOOST_TEST(a.settings[2].counters.front().second == 2 * a.settings[1].counters.front().second);
}

BOOST_AUTO_TEST_CASE(setting_with_scattered_times_is_kept_as_a_tie) {
  results::CostStudy study = run_study(study_json());
  for (std::size_t i : {0U, 1U, 2U}) study.settings[i].time->cpu_s.assign(7, 1.0 + 10.0 * i);
  study.settings[1].time->cpu_s = {11, 1, 11, 300, 11, 11, 11};
  derive_time_ratios_and_front(study);
  const std::vector<CostPoint> points = cost_points(study);
  BOOST_TEST(points.size() == 3U);
  BOOST_TEST(points[1].time == 11);
  BOOST_TEST(points[1].low == 1);
  BOOST_TEST(points[1].high == 300);
  const std::vector<std::size_t> tied = {1};
  BOOST_TEST(tied_settings(points, 10) == tied, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(computation_beyond_its_time_limit_is_stopped) {
  Json json = study_json();
  json["time_limit_s"] = 1;
  json["curves"]["more"] = {
      {"title", "far too fine"},
      {"patch",
       {{"model", {{"elements", 4000}}}, {"analysis", {{"modes", {{"eigensolver", "dense"}}}}}}}};
  const results::CostStudy study = run_study(json);
  BOOST_TEST((study.settings[4].status == "timed-out"));
  BOOST_TEST(study.settings[4].cpu_s == 1);
  BOOST_TEST(contains(study.settings[4].reason, "1 s of processor time"));
}

BOOST_AUTO_TEST_CASE(error_above_1000_percent_is_a_divergence) {
  Json json = study_json();
  // Frequencies are proportional to sqrt(E), so that an excessive E makes all errors large.
  json["curves"]["more"] = {{"title", "stiff beyond reason"},
                            {"patch", {{"model", {{"materials", {{"steel", {{"E_Pa", 2e15}}}}}}}}}};
  BOOST_TEST((run_study(json).settings[4].status == "diverged"));
}

BOOST_AUTO_TEST_CASE(setting_without_error_other_than_reference_is_measured) {
  Json json = study_json();
  // The setting differs from the reference solution in its title only. Their frequencies are equal.
  json["curves"]["more"] = {{"title", "another name"},
                            {"patch", {{"title", "another"}, {"model", {{"elements", 16}}}}}};
  const results::CostStudy study = run_study(json);
  BOOST_TEST((study.settings[3].status == "reference"));
  BOOST_TEST((study.settings[4].status == "measured"));
  BOOST_TEST(*study.settings[4].errors->max == 0);
}

BOOST_AUTO_TEST_CASE(study_requires_a_reference_solution_and_a_baseline) {
  Json json = study_json();
  json["reference_solution"]["patch"]["model"]["supports"] = {{"A", nullptr}};
  json["quantities"]["frequency_Hz"]["index"] = {7};
  BOOST_TEST(contains(input_error_message([&] { (void)run_study(json); }),
                      "reference solution cannot be"));
  json = study_json();
  json["baseline"] = {{"curve", "more"}};
  BOOST_TEST(contains(input_error_message([&] { (void)run_study(json); }), "a baseline cannot be"));
}

BOOST_AUTO_TEST_CASE(results_obey_their_schema_and_keep_the_front) {
  const results::CostStudy study = run_study(study_json());
  const References references;
  results::Results filled = collect_results({}, {}, references);
  filled.cost = cost_results({study}, SweepExtent::full, {});
  const Json results = to_json(filled);
  const auto fault = find_schema_fault(results, "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  const Json& written = results["cost"]["studies"][0];
  BOOST_TEST(written["settings"].size() == 5U);
  BOOST_TEST(written["cheapest"].size() == target_errors_of_report().size());
  const std::vector<CostPoint> points = cost_points(study),
                               read = cost_points(results::read_results(results).cost->studies[0]);
  BOOST_TEST_REQUIRE(read.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    BOOST_TEST(read[i].error == points[i].error);
    BOOST_TEST(read[i].time == points[i].time);
  }
}

BOOST_AUTO_TEST_SUITE_END()
