// ctest: labels=program timeout=300
#include "harness/results/quantity_definitions.h"

#include <boost/test/unit_test.hpp>
#include <map>
#include <set>

#include "harness/input/catalogue.h"
#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(quantity_definitions)

using namespace trammel;
using namespace trammel::harness;

namespace {

/// Names of quantities without the part after the colon (heads), by type of analysis.
using Recorded = std::map<std::string, std::set<std::string>>;

/// Returns the heads of the names of quantities, except for quantities that a study defines.
std::set<std::string> quantity_heads(const Document& document, const Quantities& quantities) {
  const Json& analysis = document.value().at("analysis");
  std::set<std::string> studied, heads;
  if (analysis.contains("study")) {
    const Json& study = analysis.at("study");
    if (study.contains("quantities"))
      for (const auto& item : study.at("quantities").items()) studied.insert(item.key());
    studied.insert(study.value("parameter", "parameter"));
    heads.insert("parameter");
  }
  for (const auto& item : quantities)
    if (studied.count(item.first) == 0) heads.insert(item.first.substr(0, item.first.find(':')));
  return heads;
}

void record(const Document& document, Recorded& recorded) {
  const References references;
  const AnalysisResult result = analyze(document, references, {false});
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), document.value().at("id"));
  recorded[analysis_kind(document)].merge(quantity_heads(document, result.quantities));
}

/// Cases of the catalogue that together contain nearly all quantities.
const std::vector<std::pair<const char*, const char*>> kCases = {
    {"cooks-membrane", "base"},
    {"hard-12-grnn", "one-sample"},
    {"hard-03-repeated-frequencies", "perturbed"},
    {"claims-audit", "base"},
    {"estimated-effects", "base"},
    {"scene-10-newton", "base"},
    {"scene-table-1-modes", "base"},
    {"scene-tie-rod", "base"},
    {"scene-tie-rod", "transient"},
    {"scene-tie-rod", "harmonic"},
    {"manufactured-timoshenko", "base"},
    {"manufactured-triangles", "base"},
    {"ansys-vm136", "path"},
    {"ansys-vm85", "base"},
    {"nafems-5h", "base"},
    {"sensitivity-centred", "base"},
    {"design-sensitivity", "base"},
    {"hard-11-four-bar", "base"},
    {"hard-11-toggle", "base"},
    {"grnn-example", "one-sample"},
    {"circle-load-exact", "welded-linear"},
    {"circle-forward-dynamics", "thrown"},
};

Json with_analysis(Json json, const std::string& analysis) {
  json["analysis"] = Json::parse(analysis);
  return json;
}

/// Names of all outputs of a transient or harmonic analysis.
const std::string kOutputs = R"(["displacement_x_m:B", "displacement_y_m:B", "rotation_rad:B",
  "velocity_x_m_per_s:B", "velocity_y_m_per_s:B", "angular_velocity_rad_per_s:B",
  "acceleration_x_m_per_s2:B", "acceleration_y_m_per_s2:B", "axial_force_N:AB.start",
  "shear_force_N:AB.start", "bending_moment_N_m:AB.start", "bending_stress_Pa:AB.start",
  "stress_Pa:AB"])";

/// Returns cases with quantities that the cases in `kCases` do not have.
std::vector<Json> further_cases() {
  const Json strip = testing::cantilever();
  Json buckled = strip;
  buckled["model"]["loads"]["tip"]["force_N"] = {-100, 0};
  const Json robot = testing::manipulator();
  Json moving = robot;
  moving["model"].erase("pose");
  moving["model"]["trajectory"] = Json::parse(
      R"({"circle": {"center_m": [0.25, 0.144], "radius_m": 0.05, "points": 3, "step_s": 0.01}})");
  Json hinged = moving, long_way = moving, soft = moving;
  hinged["model"]["manipulator"]["joints"]["elbow"] = "hinged";
  long_way["model"]["trajectory"]["circle"].update({{"points", 24}, {"step_s", 0.2}});
  soft["model"]["manipulator"]["platform"].update({{"kind", "triangles"}, {"refinements", 0}});
  Json still = soft;
  still["model"]["trajectory"]["circle"]["angular_speed_rad_s"] = 0;
  const Json readings = patched(load_named_case("table-2-models"), kBaseVariant).value();
  const std::string motion = R"("step_s": 0.002, "initial_state": "quasi-static")";
  return {
      strip,
      readings,
      with_analysis(buckled, R"({"buckling": {"count": 1}})"),
      with_analysis(strip, R"({"modes": {"count": 2, "rotating": {"angular_speed_rad_s": 3}}})"),
      with_analysis(strip, R"({"transient": {"duration_s": 0.01, "step_s": 0.001, "outputs": )" +
                               kOutputs + "}}"),
      with_analysis(strip, R"({"harmonic": {"from_Hz": 1, "to_Hz": 20, "points": 2, "outputs": )" +
                               kOutputs +
                               R"(, "damping": {"modal": {"ratio": 0.02, "modes": 2}}}})"),
      with_analysis(
          strip,
          R"({"large-statics": {"vibration_modes": 1, "drives": {"push": {"node": "B", "motion": "x",
          "law": {"constant_speed": {"speed_per_s": 0.001}}}}}})"),
      with_analysis(strip, R"({"large-motion": {"end_time_s": 0.01, "step_s": 0.001,
          "relative_to": "A", "angles": {"tip": {"node": "B"}}, "drives": {
          "push": {"node": "B", "motion": "x", "law": {"constant_speed": {"speed_per_s": 0.001}}},
          "turn": {"node": "B", "motion": "rotation",
                   "law": {"constant_speed": {"speed_per_s": 0.001}}}}}})"),
      with_analysis(strip, R"({"options": {"cases": {"beam-cantilever": {}}, "analyses": {
          "modes": {"vary": {"eigensolver": ["dense", "sparse"]}, "same_results": true}}}})"),
      with_analysis(robot, R"({"modes": {"count": 2, "count_below_Hz": 5}})"),
      with_analysis(robot, R"({"sensitivity": {"count": 1, "parameters": {
          "E": {"property": "E"}, "density": {"property": "density"}}}})"),
      with_analysis(robot, R"({"sensitivity-map": {"orientations_deg": [0, 10], "columns": 5}})"),
      with_analysis(moving, R"({"modes": {"count": 2}})"),
      with_analysis(moving, R"({"modes": {"count": 2, "track_shapes": true}})"),
      with_analysis(moving, R"({"buckling": {"count": 1}})"),
      with_analysis(moving, R"({"large-statics": {}})"),
      with_analysis(hinged, R"({"properties": {}})"),
      with_analysis(hinged, R"({"kinematics": {}})"),
      with_analysis(hinged, R"({"forward-dynamics": {}})"),
      with_analysis(hinged,
                    R"({"inverse-dynamics": {"bodies": true, "points_per_revolution": 16}})"),
      with_analysis(hinged,
                    R"({"large-motion": {"track": "angles", "end_time_s": 0.02, "step_s": 0.01}})"),
      with_analysis(
          hinged, R"({"large-motion": {"track": "torques", "end_time_s": 0.02, "step_s": 0.01}})"),
      with_analysis(long_way,
                    R"({"grnn": {"train": 16, "search": {"from": 0.01, "to": 1, "count": 5}}})"),
      with_analysis(soft, "{\"elastodynamics\": {" + motion + "}}"),
      with_analysis(still, "{\"elastodynamics\": {" + motion +
                               R"(, "step_errors": true, "damping": {"stiffness_s": 1e-4}}})")};
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_quantity_is_defined_and_every_definition_used) {
  Recorded recorded;
  for (const auto& [name, variant] : kCases)
    record(patched(load_named_case(name), variant), recorded);
  for (const Json& json : further_cases()) record(testing::document_of(json), recorded);
  Recorded defined;
  for (const results::QuantityDefinition& one : results::quantity_definitions())
    for (const std::string& analysis : one.analyses) defined[analysis].insert(one.base_name());
  for (const auto& side : {recorded, defined})
    for (const auto& item : side) BOOST_TEST_CONTEXT(item.first)
  BOOST_TEST(defined[item.first] == recorded[item.first], boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(quantities_are_defined_once_and_with_a_meaning) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const results::QuantityDefinition& one : results::quantity_definitions()) {
    BOOST_TEST(!one.meaning.empty(), one.name);
    for (const std::string& analysis : one.analyses)
      BOOST_TEST(seen.emplace(analysis, one.base_name()).second, analysis << " " << one.name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
