#include "harness/statics_modes/range_warnings.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(range_warnings)

using namespace trammel;
using namespace trammel::testing;

namespace {

bool warns(const AnalysisResult& result, const std::string& text) {
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  return std::ranges::any_of(
      result.warnings, [&text](const Warning& warning) { return contains(warning.text(), text); });
}

AnalysisResult analyze_cantilever(double force_x, double force_y, const char* analysis) {
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {force_x, force_y};
  json["analysis"] = {{analysis, Json::object()}};
  AnalysisResult result = analyze_json(json);
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  return result;
}

}  // namespace

// Tests the warning about large rotations in linear statics. The rotation of the cantilever's tip
// is F L^2 / (2 E I), or 2.4e-6 rad per newton.
BOOST_AUTO_TEST_CASE(large_rotation_in_linear_statics_has_a_warning) {
  BOOST_TEST(analyze_cantilever(0, 40000, "statics").warnings.empty());
  const AnalysisResult beyond = analyze_cantilever(0, 50000, "statics");
  BOOST_REQUIRE(beyond.warnings.size() == 1U);
  BOOST_TEST(contains(beyond.warnings[0].text(), "the largest rotation is 0.12 rad: linear theory"),
             beyond.warnings[0].text());
  BOOST_TEST(analyze_cantilever(0, 50000, "large-statics").warnings.empty());
}

// Tests the warning about large strains of a member. A strip of 0.2 m was once compressed to an end
// position of -64 m without a warning. The extension N / EA and the shear V / EA of the cantilever
// in this test are 1e-9 per newton.
BOOST_AUTO_TEST_CASE(large_extension_of_a_member_has_a_warning) {
  for (const char* analysis : {"statics", "large-statics"}) {
    BOOST_TEST(analyze_cantilever(9e7, 0, analysis).warnings.empty());
    const AnalysisResult beyond = analyze_cantilever(3e8, 0, analysis);
    BOOST_REQUIRE(beyond.warnings.size() == 1U);
    BOOST_TEST(contains(beyond.warnings[0].text(), "the largest extension of a member is 0.3: "),
               beyond.warnings[0].text());
    const AnalysisResult across = analyze_cantilever(0, 3e12, analysis);
    BOOST_REQUIRE(!across.warnings.empty());
    BOOST_TEST(contains(across.warnings.back().text(), "the largest shear of a member is "));
  }
}

// Tests the warning about second-order statics near buckling. The Euler load of the cantilever is
// pi^2 E I / (4 L^2). At 0.95 of this load, the displacements are about 20 times those of linear
// theory.
BOOST_AUTO_TEST_CASE(second_order_theory_near_buckling_causes_a_warning) {
  const double critical = std::pow(std::numbers::pi / 4, 2) * 2e11 * 0.05 * 1e-3 / 12;
  for (const auto& [share, across, warned] :
       {std::tuple(0.8, 1e3, false), std::tuple(0.95, 1e3, true), std::tuple(0.99, 1e-4, true)}) {
    Json json = testing::cantilever();
    json["model"]["loads"]["tip"]["force_N"] = {-share * critical, across};
    json["analysis"] = {{"statics", {{"second_order", true}}}};
    const AnalysisResult result = analyze_json(json);
    BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
    BOOST_TEST(warns(result, "the amplification by second-order theory is ") == warned);
  }
}

BOOST_AUTO_TEST_CASE(loads_without_compression_warn_in_buckling) {
  for (const auto& [along, warned] : {std::pair(1.0, true), std::pair(-1.0, false)}) {
    const AnalysisResult result = analyze_cantilever(along, 0, "buckling");
    BOOST_TEST(result.warnings.size() == (warned ? 1U : 0U));
    if (warned)
      BOOST_TEST(contains(result.warnings[0].text(), "K + factor K_G is positive definite"));
  }
}

BOOST_AUTO_TEST_CASE(model_that_cannot_vibrate_or_buckle_is_singular) {
  const auto reason = [](const Json& supports, double density, const char* analysis) {
    Json json = testing::cantilever();
    json["model"]["elements"] = 1;
    json["model"]["supports"] = supports;
    json["model"]["materials"]["steel"]["rho_kg_m3"] = density;
    json["analysis"] = {{analysis, {{"count", 1}}}};
    const AnalysisResult result = analyze_json(json);
    BOOST_TEST((result.outcome.status == solver::Status::singular));
    return result.outcome.reason;
  };
  const Json all = {"x", "y", "rotation"};
  BOOST_TEST(reason({{"A", all}, {"B", all}}, 7800, "modes") ==
             "no vibration: every motion is restrained");
  BOOST_TEST(reason({{"A", all}, {"B", all}}, 7800, "buckling") ==
             "the model cannot buckle: every motion is restrained");
  BOOST_TEST(reason({{"A", all}}, 0, "modes") == "no vibration: no movable part has a mass");
}

// Tests the warning about reactions that equilibrium does not determine. A rigid beam on three
// supports is statically indeterminate.
BOOST_AUTO_TEST_CASE(indeterminate_reactions_cause_a_warning) {
  Json json = testing::cantilever();
  BOOST_TEST(analyze_json(json).warnings.empty());
  json["model"]["members"] = Json::object();
  json["model"]["nodes"] = {{"A", {0, 0}}, {"B", {1, 0}}, {"C", {2, 0}}};
  json["model"]["rigid_bodies"] = {{"beam", {{"reference", "A"}, {"nodes", {"B", "C"}}}}};
  json["model"]["supports"] = {{"A", {"x", "y"}}, {"B", {"y"}}, {"C", {"y"}}};
  json["model"]["loads"] = {{"tip", {{"node", "C"}, {"force_N", {0, 12}}}}};
  json["model"]["point_masses"] = {{"m", {{"node", "C"}, {"mass_kg", 1}}}};
  json["checks"] = Json::object();
  for (const Json& analysis :
       {Json{{"statics", Json::object()}}, Json{{"large-statics", Json::object()}},
        Json{{"large-motion", {{"end_time_s", 0.1}, {"step_s", 0.1}}}}}) {
    json["analysis"] = analysis;
    json["model"]["supports"]["C"] = {"y"};
    BOOST_TEST(warns(analyze_json(json), "redundant constraints is 1: "), analysis.dump());
    json["model"]["supports"].erase("C");
    BOOST_TEST(!warns(analyze_json(json), "redundant constraints"), analysis.dump());
  }
}

// The mesh is too coarse if an element is longer than half a wave of the mode. A quarter of the
// cantilever is longer than half a wave of its fourth mode.
BOOST_AUTO_TEST_CASE(frequencies_of_coarse_meshes_have_a_warning) {
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 4}}}};
  json["checks"] = Json::object();
  for (const auto& [elements, warned] : {std::pair(4, true), std::pair(16, false)}) {
    json["model"]["elements"] = elements;
    BOOST_TEST(warns(analyze_json(json), "largest dimensionless wave number") == warned, elements);
  }
}

BOOST_AUTO_TEST_CASE(coarse_meshes_of_tapered_members_cause_a_warning) {
  Json json = testing::cantilever();
  json["model"]["sections"] = {
      {"s", {{"material", "steel"}, {"rectangle", {{"thickness_m", 0.1}, {"width_m", 0.05}}}}},
      {"e", {{"material", "steel"}, {"rectangle", {{"thickness_m", 0.02}, {"width_m", 0.05}}}}}};
  for (auto& member : json["model"]["members"]) {
    member["section"] = "s";
    member["end_section"] = "e";
  }
  json["checks"] = Json::object();
  for (const auto& [elements, warned] : {std::pair(1, true), std::pair(64, false)}) {
    json["model"]["elements"] = elements;
    BOOST_TEST(warns(analyze_json(json), "ratio of stiffness at the ends of an element") == warned,
               elements);
  }
}

// Tests the warning that reduced modes do not represent the initial velocity of a cantilever, a
// uniform translation. The first mode has 61.3 % of the kinetic energy. The remaining velocity has
// the relative norm sqrt(0.387) = 0.622 on a fine mesh.
BOOST_AUTO_TEST_CASE(velocity_outside_the_reduced_basis_causes_a_warning) {
  Json json = testing::cantilever();
  json["model"]["loads"] = Json::object();
  json["model"]["elements"] = 64;
  json["checks"] = Json::object();
  json["analysis"] = Json::parse(R"({"transient": {
    "duration_s": 0.01, "step_s": 0.001, "method": "modal-superposition",
    "initial_state": {"velocity_m_per_s": [0, -1]}, "reduction": {"modes": 1},
    "outputs": ["velocity_y_m_per_s:B"]}})");
  BOOST_TEST(warns(analyze_json(json), "the reduced basis cannot represent is 0.61"));
  json["analysis"]["transient"].erase("reduction");
  BOOST_TEST(!warns(analyze_json(json), "the reduced basis cannot represent"));
}

namespace {

/// Returns statics along a path: the centered platform rotates from 0 to an angle in 40 steps.
AnalysisResult turn_platform(double angle, const Json& analysis = {{"statics", Json::object()}}) {
  Json json = Json::parse(R"({
    "id": "across", "title": "Across a singularity", "extends": "table-1.json",
    "model": {
      "manipulator": {"joints": {"elbow": "hinged"}, "platform": {"kind": "rigid"}},
      "pose": null,
      "trajectory": {"line": {"from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
                              "to": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0.9},
                              "duration_s": 1, "points": 41, "step_s": 0.025}},
      "loads": {"P": {"node": "P", "force_N": [100, 0], "moment_N_m": 0.1}}
    }
  })");
  json["model"]["trajectory"]["line"]["to"]["phi_rad"] = angle;
  json["analysis"] = analysis;
  AnalysisResult result = analyze_json(json);
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(path_has_one_warning_with_its_largest_rotation) {
  const AnalysisResult result = turn_platform(0.9);
  BOOST_REQUIRE(result.warnings.size() == 2U);
  double largest = 0;
  for (const double angle : testing::values(result, "rotation_rad:P"))
    largest = std::max(largest, std::abs(angle));
  BOOST_TEST(largest > kMaxLinearRotation);
  BOOST_TEST(result.warnings[0].value >= largest);
}

// Tests the warning about a parallel singularity of the manipulator. The lines of the distal links
// intersect in P if the platform angle is 0.669 rad, which is at 0.744 of the path.
BOOST_AUTO_TEST_CASE(path_through_a_parallel_singularity_causes_a_warning) {
  const AnalysisResult result = turn_platform(0.9);
  BOOST_TEST(contains(result.warnings.back().text(),
                      "of the first point after a parallel singularity is 0.75 s"),
             result.warnings.back().text());
  BOOST_TEST(!warns(turn_platform(0.6), "singularity"));
}

BOOST_AUTO_TEST_CASE(every_analysis_warns_of_a_crossed_singularity) {
  const std::string crossed = "of the first point after a parallel singularity is 0.75 s";
  const Json study = {{"analysis", {{"statics", Json::object()}}},
                      {"trajectory", true},
                      {"quantities", {{"displacement_x_m:P", Json::object()}}}};
  for (const Json& analysis : {Json{{"kinematics", Json::object()}}, Json{{"study", study}},
                               Json{{"grnn", {{"train", 20}, {"sigma", 0.1}}}}}) {
    BOOST_TEST(warns(turn_platform(0.9, analysis), crossed), analysis.dump());
    BOOST_TEST(!warns(turn_platform(0.6, analysis), "singularity"), analysis.dump());
  }
}

BOOST_AUTO_TEST_SUITE_END()
