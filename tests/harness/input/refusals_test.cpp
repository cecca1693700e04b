// Invalid inputs: a change of a valid case, and the pointer and message of the refusal.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <map>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(refusals)

using namespace trammel;
using namespace trammel::testing;

namespace {

/// Valid cases by name.
const std::map<std::string, Json>& cases() {
  static const std::map<std::string, Json> all = [] {
    const auto changed = [](Json json, const char* patch) {
      json.merge_patch(Json::parse(patch));
      return json;
    };
    std::map<std::string, Json> made;
    made["beam"] = testing::cantilever();
    made["ring"] = testing::quarter_ring();
    made["crank"] = testing::slider_crank();
    made["robot"] = testing::manipulator();
    made["net"] = changed(made["beam"], R"({"model": null, "analysis": {"statics": null, "grnn": {
        "samples": {"inputs": [[1], [2]], "outputs": [[3], [5]]}, "queries": [[1.5]],
        "sigma": 1}}})");
    made["vibration"] = changed(made["beam"], R"({"analysis": {"statics": null, "transient": {
        "duration_s": 0.1, "step_s": 0.01, "outputs": ["displacement_y_m:B"]}}})");
    made["response"] = changed(made["beam"], R"({"analysis": {"statics": null, "harmonic": {
        "from_Hz": 1, "to_Hz": 2, "points": 3, "outputs": ["displacement_y_m:B"]}}})");
    made["circle"] = changed(made["robot"], R"({"model": {"pose": null, "trajectory": {"circle": {
        "center_m": [0.25, 0.144], "radius_m": 0.01, "points": 3, "step_s": 0.5}}}})");
    made["motion"] = changed(made["robot"], R"({"model": {"pose": null, "trajectory": {"line": {
        "duration_s": 0.1, "points": 6, "step_s": 0.02,
        "from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
        "to": {"x_m": 0.26, "y_m": 0.144, "phi_rad": 0}}}},
        "analysis": {"modes": null, "elastodynamics": {"step_s": 0.001,
        "initial_state": "quasi-static"}}})");
    return made;
  }();
  return all;
}

/// Merge patch of a valid case, and a part of the message.
struct Refusal {
  const char *name, *patch, *message;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.name << " with " << refusal.patch;
}

const Refusal kAnalyses[] = {
    {"net", R"({"analysis": {"grnn": {"queries": [[1, 2]]}}})",
     "/analysis/grnn/queries: expected rows as long as the inputs', 1"},
    {"net", R"({"analysis": {"grnn": {"samples": {"outputs": [[1]]}}}})",
     "/analysis/grnn/samples/outputs: expected as many rows as inputs have, 2"},
    {"net", R"({"analysis": {"grnn": {"samples": {"inputs": [[1], [2, 3]]}}}})",
     "/analysis/grnn/samples/inputs/1: expected 1 numbers"},
    {"net", R"({"analysis": {"grnn": {"spread": 1}}})", "expected either 'sigma' or 'spread'"},
    {"net", R"({"analysis": {"grnn": {"sigma": 1e-320}}})",
     "/analysis/grnn: expected a valid network: the sigma"},
    {"net", R"({"analysis": {"grnn": null, "comparison": {"rows": {
        "compared": "table-2-ansys", "baseline": "table-1-link-mass"}}}})",
     "/analysis/comparison/rows: expected two references of one unit"},
    {"circle", R"({"analysis": {"modes": null, "grnn": {"train": 4}}})",
     "/analysis/grnn/train: expected no more samples than the path has points"},
    {"circle", R"({"analysis": {"modes": {"rotating": {"angular_speed_rad_s": 1}}}})",
     "/analysis/modes/rotating: expected a model at one place"},
    {"robot", R"({"analysis": {"modes": null, "inverse-dynamics": {}},
        "model": {"point_masses": {"m": {"node": "P", "mass_kg": 1}}}})",
     "/model/point_masses: expected a manipulator without other parts"},
    {"robot", R"({"analysis": {"modes": null, "inverse-dynamics": {}},
        "model": {"loads": {"l": {"node": "B1", "force_N": [1, 0]}}}})",
     "/model/loads/l/node: expected a load on the platform"},
    {"robot", R"({"analysis": {"modes": null, "forward-dynamics": {}}})",
     "/analysis/forward-dynamics: expected a model with a trajectory"},
    {"robot", R"({"analysis": {"modes": {"count_below_Hz": 100,
        "reduction": {"fixed_interface_modes": 3}}}})",
     "without 'reduction'"},
    {"beam", R"({"analysis": {"statics": null, "inverse-dynamics": {}}})",
     "/analysis/inverse-dynamics: expected a model with a manipulator"},
    {"beam", R"({"analysis": {"statics": null, "kinematics": {}}})",
     "/analysis/kinematics: expected a model with a manipulator"},
    {"beam", R"({"model": null})", "expected the key 'model'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "prestressed": true,
        "count_below_Hz": 10}}})",
     "/analysis/modes/count_below_Hz: expected it without 'prestressed'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "prestressed": true,
        "rotating": {"angular_speed_rad_s": 5}}}})",
     "/analysis/modes/prestressed: expected it without 'rotating'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "count_below_Hz": 10,
        "rotating": {"angular_speed_rad_s": 5}}}})",
     "/analysis/modes/count_below_Hz: expected it without 'rotating'"}};

const Refusal kMotions[] = {
    {"vibration", R"({"analysis": {"transient": {"outputs": ["displacment_x_m:P"]}}})",
     "/analysis/transient/outputs/0: expected a quantity"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["displacment_x_m:P"]}}})",
     "did you mean 'displacement_x_m'?"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["displacement_x_m:Q"]}}})",
     "expected the name of a node after the colon (got 'Q')"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["displacement_x_m"]}}})",
     "expected the name of a node after the colon (got '')"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["bending_moment_N_m:AB"]}}})",
     "expected an end of the member"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["stress_Pa:BC"]}}})",
     "expected the name of a member"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["bending_stress_Pa:AB.start"]}},
        "model": {"sections": {"bar": {"rectangle": null, "area_m2": 5e-3,
        "second_moment_m4": 4e-6}}}})",
     "/outputs/0: expected a member whose sections have a depth"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["axial_force_N:AB.start"],
        "rotating_frame": {"law": {"spin_up": {"speed_per_s": 5, "duration_s": 0.1}}}}},
        "model": {"loads": null}})",
     "/analysis/transient/outputs: expected only motions"},
    {"vibration", R"({"analysis": {"transient": {"load_history": {"time_s": [0, 1],
        "factor": [1]}}}})",
     "/load_history/factor: expected 2 numbers"},
    {"vibration", R"({"analysis": {"transient": {"load_history": {"time_s": [1, 0],
        "factor": [1, 1]}}}})",
     "/load_history/time_s/1: expected ascending times"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1,
        "modes": 99}}}}})",
     "/damping/modal: expected at most"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1}}}}})",
     "/damping/modal: expected the key 'modes'"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": [0.1],
        "modes": 1}}}}})",
     "/damping/modal/modes: 'modes' requires a single ratio"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1,
        "modes": "all"}}}}})",
     "/damping/modal/modes: expected a number"},
    {"vibration", R"({"analysis": {"transient": {"method": "modal-superposition",
        "error_control": {"relative": 1e-4}}}})",
     "/error_control: expected it without 'modal-superposition'"},
    {"vibration", R"({"analysis": {"transient": {"step_s": 1e-12}}})",
     "/step_s: expected at most ten million steps"},
    {"response", R"({"analysis": {"harmonic": {"to_Hz": 1}}})",
     "/to_Hz: expected more than 'from_Hz'"},
    {"response", R"({"analysis": {"harmonic": {"damping": {"modal": {"ratio": 0.1,
        "modes": 99}}}}})",
     "/analysis/harmonic/damping: there are 99 damping ratios"},
    {"motion", R"({"analysis": {"elastodynamics": {"effects": {"elastic_inertia": false,
        "transformation_rate_terms": true}}}})",
     "/analysis/elastodynamics/effects/transformation_rate_terms"},
    {"motion", R"({"analysis": {"elastodynamics": {"modal_superposition": true}}})",
     "/analysis/elastodynamics/modal_superposition: expected a platform at rest"},
    {"motion", R"({"analysis": {"elastodynamics": {"step_s": 1e-12}}})",
     "/analysis/elastodynamics/step_s: expected at most ten million steps"},
    {"motion", R"({"analysis": {"elastodynamics": {"load_history": {"time_s": [0, 1],
        "factor": [0, 1]}}}, "effects": {"auto": {"tolerance": 0.01}}})",
     "automatic effects require a constant load"},
    {"crank", R"({"analysis": {"large-motion": null, "statics": {}}, "model": {"axial_springs": {
        "k": {"nodes": ["O", "S"], "stiffness_N_per_m": 1000}}}})",
     "large-statics or large-motion"},
    {"crank", R"({"analysis": {"large-motion": {"drives": {"motor": {"node": "A "}}}}})",
     "/analysis/large-motion/drives/motor/node: expected the name of a node (got 'A '); did you "
     "mean 'A'?"},
    {"crank", R"({"model": {"pins": {"p": {"nodes": ["A", "S"]}}}})", "/model/pins/p/nodes"},
    {"crank", R"({"analysis": {"large-motion": {"relative_to": "S"}}})",
     "/analysis/large-motion/relative_to: expected a node that has a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"angles": {"a": {"node": "S"}}}}})",
     "/analysis/large-motion/angles/a/node: expected a node that has a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"angles": {"a": {"node": "A", "from": "S"}}}}})",
     "/analysis/large-motion/angles/a/from: expected a node that has a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"load_history": {"time_s": [0.1, 0.1],
        "factor": [0, 1]}}}})",
     "/time_s/1: expected a continuous function"},
    {"crank", R"({"analysis": {"large-motion": {"load_ramp_s": 0.1,
        "load_history": {"time_s": [0.1, 0.2], "factor": [0, 1]}}}})",
     "without 'load_ramp_s'"},
    {"crank", R"({"model": {"members": {"crank": {"ends": ["hinged", "hinged"]}}}})",
     "/analysis/large-motion/drives/motor: "},
    {"crank", R"({"analysis": {"large-motion": {"step_s": 1e-12, "output_step_s": 0.01}}})",
     "/analysis/large-motion/step_s: expected at most ten million steps"},
    {"robot", R"({"analysis": {"modes": null, "large-motion": {"end_time_s": 0.1, "step_s": 0.005,
        "drives": {"motor": {"node": "A1", "motion": "rotation",
        "law": {"constant_speed": {"speed_per_s": 1}}}}}},
        "model": {"manipulator": {"joints": {"active": "free"}}}})",
     "/analysis/large-motion/drives/motor: expected an actuator that is locked"}};

const Refusal kEffects[] = {
    {"beam", R"({"effects": ["shear"]})",
     "/effects/0: expected an effect that the scene admits (got 'shear': the members do not shear "
     "('beam'))"},
    {"beam", R"({"effects": ["large-displacement"]})",
     "expected 'geometric-stiffening' with 'large-displacement'"},
    {"beam", R"({"effects": ["sheer"]})", "did you mean"},
    {"beam", R"({"effects": [], "analysis": {"statics": null, "properties": {}}})",
     "expected an analysis with effects"},
    {"beam", R"({"effects": ["axial-flexibility", "geometric-stiffening"],
        "analysis": {"statics": {"second_order": true}}})",
     "expected 'effects' alone to say it"},
    {"motion", R"({"effects": ["axial-flexibility", "inertia", "large-displacement"]})",
     "expected 'gyroscopic' with 'large-displacement'"},
    {"motion", R"({"effects": ["axial-flexibility", "large-displacement"],
        "analysis": {"elastodynamics": {"load_history": {"time_s": [0, 1, 1],
        "factor": [0, 0, 1]}}}})",
     "it requires a load history without jumps"}};

const Refusal kModels[] = {
    {"beam", R"({"model": {"members": {"AB": {"section": "bra"}}}})",
     "/model/members/AB/section: expected the name of a section (got 'bra'); did you mean 'bar'?"},
    {"beam", R"({"model": {"members": {"AB": {"nodes": ["A", "Q"]}}}})",
     "/model/members/AB/nodes/1: expected the name of a node (got 'Q')"},
    {"beam", R"({"model": {"supports": {"Z": ["x"]}}})",
     "/model/supports/Z: expected the name of a node"},
    {"beam", R"({"model": {"nodes": {"B": [0, 0]}}})",
     "/model/members/AB/nodes: expected two nodes at different positions"},
    {"beam", R"({"model": {"sections": {"bar": {"circle": {"diameter_m": 0.1}}}}})",
     "/model/sections/bar: expected exactly one of 'rectangle', 'circle'"},
    {"beam", R"({"model": {"nodes": {"C": [4, 0]}, "plates": {"p": {"material": "steel",
        "thickness_m": 1, "triangles": [["A", "B", "C"]]}}}})",
     "/model/plates/p/triangles/0: expected a triangle with an area"},
    {"beam", R"({"model": {"pose": {"x_m": 0, "y_m": 0, "phi_rad": 0}}})",
     "/model/pose: expected it with a manipulator"},
    {"beam", R"({"model": {"loads": {"tip": {"force_N": null}}}})", "the load is empty"},
    {"beam", R"({"model": {"members": {"AB": {"arc_center_m": [0.5, 1]}}}})",
     "/model/members/AB/arc_center_m: expected a center at equal distances"},
    {"beam", R"({"model": {"members": {"AB": {"taper": "exponential"}}}})",
     "/model/members/AB/taper: 'taper' requires 'end_section'"},
    {"beam", R"({"model": {"sections": {"thin": {"material": "steel", "area_m2": 0.001,
        "second_moment_m4": 1e-8}}, "members": {"AB": {"end_section": "thin"}}}})",
     "/model/members/AB/end_section: expected two rectangles or two circles"},
    {"ring", R"({"model": {"nodes": {"B": [2.1, 0]}}})",
     "/model/edges/outer/nodes/0: expected a node on the edge's curve (got (2.1, 0) m, 1.05 times "
     "as far from its center)"},
    {"ring", R"({"model": {"edges": {"bottom": {"nodes": ["A", "C"]}}}})",
     "/model/edges/bottom/nodes/1: expected the other end of a block's side"},
    {"ring", R"({"model": {"edges": {"bottom": {"nodes": ["A", "A"]}}}})",
     "/model/edges/bottom/nodes/1: expected another node than the one before"},
    {"ring", R"({"model": {"edges": {"again": {"nodes": ["B", "C"]}}}})",
     "expected a piece that belongs to no other edge"},
    {"ring", R"({"model": {"edges": {"A": {"nodes": ["C", "D"]}}}})",
     "/model/edges/A: expected another name: there is a node of that name"},
    {"ring", R"({"model": {"edges": {"outer": {"ellipse": {"center_m": [0, 0],
        "semi_axes_m": [2, 2]}}}}})",
     "/model/edges/outer: expected at most one of 'ellipse' and 'circle'"},
    {"ring", R"({"model": {"supports": {"innner": ["x"]}}})",
     "/model/supports/innner: expected the name of a node or edge (got 'innner')"},
    {"ring", R"({"model": {"supports": {"left": ["rotation"]}}})",
     "/model/supports/left: expected x and y alone"},
    {"ring", R"({"model": {"plates": {"ring": {"blocks": {"b": {
        "corners": ["A", "D", "C", "B"]}}}}}})",
     "/model/plates/ring/blocks/b/corners: expected a convex quadrilateral"},
    {"ring", R"({"model": {"plates": {"ring": {"triangles": [["A", "B", "C"]]}}}})",
     "/model/plates/ring: expected exactly one of 'triangles' and 'blocks'"},
    {"ring", R"({"model": {"nodes": {"M": [1.4, 1.4]}}})",
     "/model/nodes/M: expected the position of a mesh node (got (1.4, 1.4)"},
    {"ring", R"({"model": {"nodes": {"E": [3, 0], "F": [3, 3]}, "plates": {"ring": {"blocks": {
        "c": {"corners": ["B", "E", "F", "C"], "cells": [1, 3]}}}}}})",
     "/model/plates/ring/blocks/c: expected the same mesh on both sides"},
    {"ring", R"({"model": {"nodes": {"E": [3, 0], "F": [3, 3]}, "plates": {"ring": {"blocks": {
        "c": {"corners": ["B", "E", "F", "C"], "cells": [1, 2]}}}}}})",
     "/model/loads/p/edge: expected an edge with a plate on one side"},
    {"ring", R"({"model": {"loads": {"p": {"node": "A"}}}})",
     "/model/loads/p: expected exactly one of 'node' and 'edge'"},
    {"ring", R"({"model": {"loads": {"p": {"force_N": [1, 2]}}}})",
     "/model/loads/p/force_N: 'force_N' requires 'node'"},
    {"ring", R"({"model": {"loads": {"q": {"node": "A", "normal_Pa": 2}}}})",
     "/model/loads/q/normal_Pa: 'normal_Pa' requires 'edge'"},
    {"ring", R"({"model": {"loads": {"p": {"edge": "outr"}}}})",
     "/model/loads/p/edge: expected the name of an edge (got 'outr'); did you mean 'outer'?"},
    {"robot", R"({"model": {"pose": {"x_m": 1}}})",
     "/model/pose: expected a pose within reach (limb 1"},
    {"circle", R"({"model": {"trajectory": {"circle": {"radius_m": 0.3}}}})",
     "/model/trajectory: expected a pose within reach at point 0"},
    {"robot", R"({"model": {"manipulator": {"platform": {"kind": "triangles"},
        "joints": {"platform": "welded"}}}})",
     "/model/manipulator: expected a valid model: "},
    {"robot", R"({"model": {"manipulator": {"base_m": [[0, 0], [1, 0], [0, 1]]}}})",
     "/model/manipulator: expected either 'base_side_m' or 'base_m' (got both"},
    {"robot", R"({"model": {"elements": 8}})", "/model/manipulator/links"},
    {"robot", R"({"model": {"nodes": {"P": [0, 0]}}})", "/model/nodes/P: expected another name"},
    {"motion", R"({"model": {"trajectory": {"line": null, "spline": {"points": 5, "step_s": 0.1,
        "knots": [{"time_s": 0, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.1, "x_m": 0.26, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.2, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0}]}}}})",
     "/model/trajectory/spline: expected a valid path: the time"},
    {"motion", R"({"model": {"trajectory": {"line": null, "spline": {"points": 2, "step_s": 0.1,
        "knots": [{"time_s": 0.05, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.1, "x_m": 0.26, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.2, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0}]}}}})",
     "/model/trajectory/spline/knots/0: expected the first knot at 0 s"},
    {"motion", R"({"model": {"trajectory": {"circle": {"center_m": [0.25, 0.144],
        "radius_m": 0.01, "points": 3, "step_s": 0.5}}}})",
     "/model/trajectory: expected exactly one of"}};

void check(const Refusal& refusal) {
  Json json = cases().at(refusal.name);
  json.merge_patch(Json::parse(refusal.patch));
  const std::string message = testing::complaint([&] { (void)testing::result_of(json); });
  BOOST_TEST(contains(message, refusal.message), message);
}

}  // namespace

BOOST_AUTO_TEST_CASE(unchanged_cases_are_accepted) {
  for (const auto& [name, json] : cases())
    BOOST_TEST(testing::complaint([&json = json] { (void)testing::result_of(json); }) == "", name);
}

BOOST_DATA_TEST_CASE(invalid_model_is_refused, kModels, refusal) {
  check(refusal);
}

BOOST_DATA_TEST_CASE(invalid_analysis_is_refused, kAnalyses, refusal) {
  check(refusal);
}

BOOST_DATA_TEST_CASE(invalid_motion_is_refused, kMotions, refusal) {
  check(refusal);
}

BOOST_DATA_TEST_CASE(invalid_effects_are_refused, kEffects, refusal) {
  check(refusal);
}

BOOST_AUTO_TEST_SUITE_END()
