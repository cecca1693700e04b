#include <boost/test/unit_test.hpp>
#include <cmath>

#include "reports/data/results.h"
#include "reports/figures/figures.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(cost)

using namespace trammel::testing;
using namespace trammel::reports;

namespace {

CostSetting measured_setting(const std::string& curve, int elements, double error, double time) {
  CostSetting setting;
  setting.curve = setting.curve_title = curve;
  setting.title = curve + ", " + std::to_string(elements) + " elements";
  setting.status = "measured";
  setting.value = elements;
  setting.errors = ErrorNorms{error, error / 2, error / 3};
  setting.cpu_s = 1e-3 * time;
  setting.relative = time;
  setting.time = SettingTime{{1e-3 * time}, 0.95 * time, 1.05 * time, 1e-3 * time, 2};
  setting.counters = {{"element_evaluations", 12}, {"factorizations", 2}, {"solves", 20}};
  setting.pareto_optimal = curve == "sparse";
  return setting;
}

CostSetting setting_without_result(int elements, const std::string& status,
                                   const std::string& reason) {
  CostSetting setting = measured_setting("dense", elements, 1, 1);
  setting.status = status;
  setting.reason = reason;
  setting.errors.reset();
  setting.time.reset();
  return setting;
}

/// Returns a cost study with seven settings of a curve "sparse", six of a curve "dense", and two
/// settings without a result.
Results cost_results() {
  CostStudy study;
  study.id = "sample-modes";
  study.family = "modes";
  study.title = "Frequencies of a sample";
  study.norm = "max";
  study.conclusion = "Within 1 %, 'sparse, 2 elements' is cheapest.";
  for (int n = 1; n <= 64; n *= 2)
    study.settings.push_back(measured_setting("sparse", n, 0.1 * std::pow(n, -4), 0.5 + n));
  for (int n = 1; n <= 32; n *= 2)
    study.settings.push_back(measured_setting("dense", n, 0.1 * std::pow(n, -4), 0.6 + n * n));
  study.settings.push_back(setting_without_result(64, "timed-out", "not done after 60 s"));
  study.settings.push_back(setting_without_result(128, "failed", "six modes of <three>"));
  study.cheapest = {{0.05, 1, {0}}, {1e-3, 2, {}}, {1e-6, {}, {}}};
  study.repeatability = 0.034;
  Results results = sample_results_of_case("none");
  results.cases.clear();
  results.references.clear();
  results.cost = CostStudies{"quick", 1, 7, 0.05, 10, {study}};
  return results;
}

}  // namespace

BOOST_AUTO_TEST_CASE(data_contain_settings_with_and_without_result) {
  CostStudy study = cost_results().cost->studies[0];
  const Figure figure = cost_figure(study);
  BOOST_TEST(figure.data.rows.size() == study.settings.size());
  const std::string csv = to_csv(figure.data);
  BOOST_TEST(contains(csv, "error_max,error_rms,error_mean"));
  BOOST_TEST(contains(csv, "element_evaluations,factorizations,solves"));
  BOOST_TEST(contains(csv, "\"dense, 64 elements\",dense,64,timed-out"));
  BOOST_TEST(contains(figure.caption, "2 settings without a result"));
  study.settings.resize(7);
  BOOST_TEST(cost_figure(study).caption.ends_with(study.conclusion));
}

BOOST_AUTO_TEST_CASE(page_of_studies_has_figure_table_and_sweep) {
  Results results = cost_results();
  const std::string text = page_of(results);
  BOOST_TEST(markup_fault(text, true) == "");
  for (const char* part :
       {"<h1>Accuracy and computing time</h1>", "<figure id=\"fig-cost-sample-modes\">",
        "This is the quick sweep", "sparse, 4 elements", "none of these settings",
        "the times of odd and of even repeats differ by at most 3.4\u202f%."})
    BOOST_TEST(contains(text, part), part);
  for (const char* part : {"id=\"summary\"", "href=\"#summary\"", "Computing time of this report"})
    BOOST_TEST(!contains(text, part), part);
  results.cost->sweep = "full";
  BOOST_TEST(contains(page_of(results), "This is the full sweep"));
}

BOOST_AUTO_TEST_SUITE_END()
