#include <boost/test/unit_test.hpp>

#include "reports/data/results.h"
#include "reports/figures/figures.h"
#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(cost)

using namespace trammel::testing;
using namespace trammel::reports;

namespace {

const std::string& page() {
  static const std::string text = text_of(sample_report() / "index.html");
  return text;
}

CostStudies sample_studies() {
  return *trammel::results::read_results(sample_results()).cost;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(all_settings_stand_in_the_data_those_without_an_answer_too) {
  const CostStudies cost = sample_studies();
  const Figure figure = cost_figure(cost.studies[0]);
  BOOST_TEST(figure.data.rows.size() == cost.studies[0].settings.size());
  const std::string csv = to_csv(figure.data);
  BOOST_TEST(contains(csv, "error_max,error_rms,error_mean"));
  BOOST_TEST(contains(csv, "element_evaluations,factorizations,solves"));
  BOOST_TEST(contains(csv, "\"dense, 64 elements\",dense,64,timed-out"));
  BOOST_TEST(contains(figure.caption, "2 settings without an answer"));
  // The strip, and a cross in it.
  BOOST_TEST(contains(figure.commands, "no answer"));
  BOOST_TEST(contains(figure.commands, "pt 2"));
}

BOOST_AUTO_TEST_CASE(without_failures_there_is_no_strip) {
  CostStudy study = sample_studies().studies[0];
  study.settings.resize(7);
  const Figure figure = cost_figure(study);
  BOOST_TEST(!contains(figure.commands, "no answer"));
  BOOST_TEST(figure.caption == study.conclusion);
}

BOOST_AUTO_TEST_CASE(the_page_has_figure_table_sentence_and_says_which_sweep_it_is) {
  BOOST_TEST(contains(page(), "<figure id=\"fig-cost-sample-modes\">"));
  BOOST_TEST(contains(page(), "This is the quick sweep"));
  BOOST_TEST(contains(page(), "sparse, 4 elements"));
  BOOST_TEST(contains(page(), "none of these settings"));
  BOOST_TEST(contains(page(), "dense, 64 elements: out of time"));
  BOOST_TEST(contains(page(), "six modes of &lt;three&gt;"));
  BOOST_TEST(contains(page(), "6 of 7 settings on the Pareto front in both halves"));
}

BOOST_AUTO_TEST_CASE(results_of_studies_alone_are_a_page_of_their_own) {
  auto json = sample_results();
  json["runs"] = nlohmann::ordered_json::array();
  json["cases"] = json["references"] = nlohmann::ordered_json::object();
  json["cost"]["sweep"] = "full";
  const Workspace space;
  const std::string text = text_of(write_report_of(space.results(json), space.path()));
  BOOST_TEST(markup_fault(text, true) == "");
  BOOST_TEST(contains(text, "<h1>Accuracy and computing time</h1>"));
  BOOST_TEST(contains(text, "This is the full sweep"));
  BOOST_TEST(!contains(text, "id=\"summary\""));
  BOOST_TEST(!contains(text, "href=\"#summary\""));
  BOOST_TEST(!contains(text, "Computing time of this report"));
}

BOOST_AUTO_TEST_SUITE_END()
