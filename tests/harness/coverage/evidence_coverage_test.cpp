#include "harness/coverage/evidence_coverage.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "harness/results/quantity_definitions.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(evidence_coverage)

using namespace trammel;
using namespace trammel::testing;

namespace {

/// Returns the types of evidence for a feature from a case with one check of displacement_y_m:B.
std::vector<std::string> evidence_of_check(const Json& check, const std::string& feature,
                                           const Json& analysis = {}) {
  const Folder folder;
  folder.write_reference("truth", "m", 1, {{"absolute", 0}});
  Json json = testing::cantilever();
  json["checks"] = {{"c", check}};
  if (!analysis.is_null()) json["analysis"] = analysis;
  const References references;
  const auto rows = harness::evidence_coverage({testing::read(folder, json)}, references);
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const auto& one) { return one.feature == feature; });
  BOOST_REQUIRE((row != rows.end()));
  return row->evidence;
}

Json printed_check() {
  return {{"quantity", "displacement_y_m:B"},
          {"reference", "truth"},
          {"role", "verification"},
          {"tolerance", {{"relative", 1e-3}, {"why", "a reason"}}}};
}

using List = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_CASE(features_of_a_case_have_the_names_of_the_schema) {
  const CaseFeatures all = case_features_of_schema();
  for (const char* feature : {"model.members", "member.taper", "beam = timoshenko", "spring.nodes",
                              "analysis.modes.rotating", "rotating.axis = x", "effects = shear"})
    BOOST_TEST(all.count(feature) == 1, feature);
  Json json = testing::cantilever();
  json["model"]["members"].begin().value()["beam"] = "timoshenko";
  const CaseFeatures own = features_of_document(json);
  BOOST_TEST(own.count("beam = timoshenko") == 1);
  BOOST_TEST(own.count("beam = euler-bernoulli") == 0);
  BOOST_TEST(std::includes(all.begin(), all.end(), own.begin(), own.end()));
}

BOOST_AUTO_TEST_CASE(check_counts_for_quantity_and_features_of_the_model) {
  for (const char* feature :
       {"model.supports", "statics with model.members", "statics: displacement_y_m:NODE"})
    BOOST_TEST(evidence_of_check(printed_check(), feature) == List{"published"},
               boost::test_tools::per_element());
  BOOST_TEST(evidence_of_check(printed_check(), "statics: displacement_x_m:NODE").empty());
  BOOST_TEST(evidence_of_check(printed_check(), "slider.rail").empty());
}

BOOST_AUTO_TEST_CASE(bounds_and_discrepancies_are_not_independent_evidence) {
  const char* feature = "model.supports";
  BOOST_TEST(evidence_of_check({{"quantity", "displacement_y_m:B"},
                                {"role", "verification"},
                                {"bound", {{"at_most", 1}, {"why", "w"}}}},
                               feature) == List{"self-consistency"},
             boost::test_tools::per_element());
  Json check = printed_check();
  check["negative_control"] = {{"verdict", "fail"}, {"message", "m"}, {"why", "w"}};
  BOOST_TEST(evidence_of_check(check, feature).empty());
  check = printed_check();
  check.erase("tolerance");
  check["role"] = "validation";
  BOOST_TEST(evidence_of_check(check, feature).empty());
  check["expect"] = {{"known_discrepancy", "w"}, {"relative_between", {0.1, 0.2}}};
  BOOST_TEST(evidence_of_check(check, feature).empty());
}

BOOST_AUTO_TEST_CASE(study_error_is_evidence_of_the_kind_of_its_reference) {
  const Json study = Json::parse(R"({
    "analysis": {"statics": {}}, "pointers": ["/model/elements"], "values": [1, 2],
    "quantities": {"displacement_y_m:B": {"reference": "truth"},
                   "displacement_x_m:B": {"relative_to": "last"}}})");
  Json check = {{"quantity", "relative_error:displacement_y_m:B"},
                {"role", "verification"},
                {"bound", {{"at_most", 1}, {"why", "w"}}}};
  const char* feature = "model.supports";
  BOOST_TEST(evidence_of_check(check, feature, {{"study", study}}) == List{"published"},
             boost::test_tools::per_element());
  check["quantity"] = "relative_error:displacement_x_m:B";
  BOOST_TEST(evidence_of_check(check, feature, {{"study", study}}) == List{"self-consistency"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(self_consistency_alone_is_not_verification) {
  results::CoverageRow row;
  BOOST_TEST(!row.is_verified());
  row.evidence = {"self-consistency"};
  BOOST_TEST(!row.is_verified());
  row.evidence = {"self-consistency", "exact"};
  BOOST_TEST(row.is_verified());
}

BOOST_AUTO_TEST_CASE(quantity_with_a_failed_check_is_not_counted_as_judged) {
  results::Results made;
  results::Run run;
  run.case_id = "a";
  run.quantities["frequency_Hz"].values = {1.0};
  results::Check check;
  check.quantity = "frequency_Hz";
  run.checks = {check};
  made.cases.resize(1);
  made.cases[0].id = "a";
  made.cases[0].analysis = "modes";
  for (const auto& [verdict, judged] :
       {std::pair(results::Verdict::pass, 1), std::pair(results::Verdict::fail, 0),
        std::pair(results::Verdict::error, 0), std::pair(results::Verdict::recorded, 0)}) {
    run.checks[0].verdict = verdict;
    made.runs = {run};
    std::vector<results::CoverageRow> rows = {
        {"quantity", "modes: " + results::find_quantity_definition("frequency_Hz", "modes")->name}};
    count_quantity_runs(made, rows);
    BOOST_TEST(rows[0].judged == judged);
  }
}

BOOST_AUTO_TEST_SUITE_END()
