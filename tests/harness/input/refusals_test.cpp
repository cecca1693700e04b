// Invalid inputs: each is a change of a valid case, with the JSON pointer and message of the error.
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

/// Merge patch that makes a valid case invalid, and a part of the expected error message.
struct Refusal {
  const char *name, *patch, *message;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.name << " with " << refusal.patch;
}

const Refusal kAnalyses[] = {
    {"net", R"({"analysis": {"grnn": {"queries": [[1, 2]]}}})",
     "/analysis/grnn/queries: expected rows of 1 numbers, as in 'inputs'"},
    {"net", R"({"analysis": {"grnn": {"samples": {"outputs": [[1]]}}}})",
     "/analysis/grnn/samples/outputs: expected the number of rows of 'inputs', 2"},
    {"net", R"({"analysis": {"grnn": {"samples": {"inputs": [[1], [2, 3]]}}}})",
     "/analysis/grnn/samples/inputs/1: expected 1 numbers"},
    {"net", R"({"analysis": {"grnn": {"spread": 1}}})",
     "expected at most one of 'sigma' and 'spread'"},
    {"net", R"({"analysis": {"grnn": {"sigma": 1e-320}}})",
     "/analysis/grnn: expected a valid network: the sigma"},
    {"net", R"({"analysis": {"grnn": null, "comparison": {"rows": {
        "compared": "table-2-ansys", "baseline": "table-1-link-mass"}}}})",
     "/analysis/comparison/rows: expected two references with equal units"},
    {"circle", R"({"analysis": {"modes": null, "grnn": {"train": 4}}})",
     "/analysis/grnn/train: expected at most the number of points of the trajectory"},
    {"circle", R"({"analysis": {"modes": {"rotating": {"angular_speed_rad_s": 1}}}})",
     "/analysis/modes/rotating: 'rotating' requires one 'pose'"},
    {"robot", R"({"analysis": {"modes": null, "inverse-dynamics": {}},
        "model": {"point_masses": {"m": {"node": "P", "mass_kg": 1}}}})",
     "/model/point_masses: this analysis does not support parts other than the manipulator"},
    {"robot", R"({"analysis": {"modes": null, "inverse-dynamics": {}},
        "model": {"loads": {"l": {"node": "B1", "force_N": [1, 0]}}}})",
     "/model/loads/l/node: a load requires a node of the platform"},
    {"robot", R"({"analysis": {"modes": null, "forward-dynamics": {}}})",
     "/analysis/forward-dynamics: forward dynamics requires a model with 'trajectory'"},
    {"robot", R"({"analysis": {"modes": {"count_below_Hz": 100,
        "reduction": {"fixed_interface_modes": 3}}}})",
     "this key excludes 'reduction'"},
    {"beam", R"({"analysis": {"statics": null, "inverse-dynamics": {}}})",
     "/analysis/inverse-dynamics: expected a model with 'manipulator'"},
    {"beam", R"({"analysis": {"statics": null, "kinematics": {}}})",
     "/analysis/kinematics: expected a model with 'manipulator'"},
    {"beam", R"({"model": null})", "this analysis requires the key 'model'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "prestressed": true,
        "count_below_Hz": 10}}})",
     "/analysis/modes/count_below_Hz: this key excludes 'prestressed'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "prestressed": true,
        "rotating": {"angular_speed_rad_s": 5}}}})",
     "/analysis/modes/prestressed: this key excludes 'rotating'"},
    {"beam", R"({"analysis": {"statics": null, "modes": {"count": 1, "count_below_Hz": 10,
        "rotating": {"angular_speed_rad_s": 5}}}})",
     "/analysis/modes/count_below_Hz: this key excludes 'rotating'"}};

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
     "/outputs/0: bending stress requires a section with a depth"},
    {"vibration", R"({"analysis": {"transient": {"outputs": ["axial_force_N:AB.start"],
        "rotating_frame": {"law": {"spin_up": {"speed_per_s": 5, "duration_s": 0.1}}}}},
        "model": {"loads": null}})",
     "/analysis/transient/outputs: with 'rotating_frame', expected only displacements"},
    {"vibration", R"({"analysis": {"transient": {"load_history": {"time_s": [0, 1],
        "factor": [1]}}}})",
     "/load_history/factor: expected 2 numbers"},
    {"vibration", R"({"analysis": {"transient": {"load_history": {"time_s": [1, 0],
        "factor": [1, 1]}}}})",
     "/load_history/time_s/1: this time is less than the previous one"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1,
        "modes": 99}}}}})",
     "/damping/modal: expected at most"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1}}}}})",
     "/damping/modal: a single damping 'ratio' requires 'modes'"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": [0.1],
        "modes": 1}}}}})",
     "/damping/modal/modes: 'modes' requires a single 'ratio'"},
    {"vibration", R"({"analysis": {"transient": {"damping": {"modal": {"ratio": 0.1,
        "modes": "all"}}}}})",
     "/damping/modal/modes: 'all' requires the method"},
    {"vibration", R"({"analysis": {"transient": {"method": "modal-superposition",
        "error_control": {"relative": 1e-4}}}})",
     "/error_control: this key excludes 'modal-superposition'"},
    {"vibration", R"({"analysis": {"transient": {"step_s": 1e-12}}})",
     "/step_s: the step is too small; expected at most ten million steps"},
    {"response", R"({"analysis": {"harmonic": {"to_Hz": 1}}})",
     "/to_Hz: expected a frequency above 'from_Hz'"},
    {"response", R"({"analysis": {"harmonic": {"damping": {"modal": {"ratio": 0.1,
        "modes": 99}}}}})",
     "/analysis/harmonic/damping: there are 99 damping ratios"},
    {"motion", R"({"analysis": {"elastodynamics": {"effects": {"elastic_inertia": false,
        "transformation_rate_terms": true}}}})",
     "/analysis/elastodynamics/effects/transformation_rate_terms"},
    {"motion", R"({"analysis": {"elastodynamics": {"modal_superposition": true}}})",
     "/analysis/elastodynamics/modal_superposition: modal superposition requires constant mass"},
    {"motion", R"({"analysis": {"elastodynamics": {"step_s": 1e-12}}})",
     "/analysis/elastodynamics/step_s: the step is too small; expected at most ten million steps"},
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
     "/analysis/large-motion/relative_to: expected a node with a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"angles": {"a": {"node": "S"}}}}})",
     "/analysis/large-motion/angles/a/node: expected a node with a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"angles": {"a": {"node": "A", "from": "S"}}}}})",
     "/analysis/large-motion/angles/a/from: expected a node with a rotation"},
    {"crank", R"({"analysis": {"large-motion": {"load_history": {"time_s": [0.1, 0.1],
        "factor": [0, 1]}}}})",
     "/time_s/1: the factor jumps; expected a continuous function"},
    {"crank", R"({"analysis": {"large-motion": {"load_ramp_s": 0.1,
        "load_history": {"time_s": [0.1, 0.2], "factor": [0, 1]}}}})",
     "not allowed with 'load_ramp_s'"},
    {"crank", R"({"model": {"members": {"crank": {"ends": ["hinged", "hinged"]}}}})",
     "/analysis/large-motion/drives/motor: "},
    {"crank", R"({"analysis": {"large-motion": {"step_s": 1e-12, "output_step_s": 0.01}}})",
     "/analysis/large-motion/step_s: the step is too small; expected at most ten million steps"},
    {"robot", R"({"analysis": {"modes": null, "large-motion": {"end_time_s": 0.1, "step_s": 0.005,
        "drives": {"motor": {"node": "A1", "motion": "rotation",
        "law": {"constant_speed": {"speed_per_s": 1}}}}}},
        "model": {"manipulator": {"joints": {"active": "free"}}}})",
     "/analysis/large-motion/drives/motor: a free active joint cannot be driven"}};

const Refusal kEffects[] = {
    {"beam", R"({"effects": ["shear"]})",
     "/effects/0: this effect is not applicable ('shear': members have no shear strain ('beam'))"},
    {"beam", R"({"effects": ["large-displacement"]})",
     "expected 'geometric-stiffening' too: 'large-displacement' requires"},
    {"beam", R"({"effects": ["sheer"]})", "did you mean"},
    {"beam", R"({"effects": [], "analysis": {"statics": null, "properties": {}}})",
     "this analysis does not support 'effects'"},
    {"beam", R"({"effects": ["axial-flexibility", "geometric-stiffening"],
        "analysis": {"statics": {"second_order": true}}})",
     "'effects' excludes this key"},
    {"motion", R"({"effects": ["axial-flexibility", "inertia", "large-displacement"]})",
     "expected 'gyroscopic' in the list: 'large-displacement' with"},
    {"motion", R"({"effects": ["axial-flexibility", "large-displacement"],
        "analysis": {"elastodynamics": {"load_history": {"time_s": [0, 1, 1],
        "factor": [0, 0, 1]}}}})",
     "the load history must not have jumps"}};

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
     "/model/pose: this key requires 'manipulator'"},
    {"beam", R"({"model": {"loads": {"tip": {"force_N": null}}}})", "the load is empty"},
    {"beam", R"({"model": {"members": {"AB": {"arc_center_m": [0.5, 1]}}}})",
     "/model/members/AB/arc_center_m: the center of an arc requires equal distances"},
    {"beam", R"({"model": {"members": {"AB": {"taper": "exponential"}}}})",
     "/model/members/AB/taper: 'taper' requires 'end_section'"},
    {"beam", R"({"model": {"sections": {"thin": {"material": "steel", "area_m2": 0.001,
        "second_moment_m4": 1e-8}}, "members": {"AB": {"end_section": "thin"}}}})",
     "/model/members/AB/end_section: expected two rectangles or two circles"},
    {"ring", R"({"model": {"nodes": {"B": [2.1, 0]}}})",
     "/model/edges/outer/nodes/0: expected a node on the curve of the edge (got (2.1, 0) m, 1.05 "
     "times as far from the center as the curve)"},
    {"ring", R"({"model": {"edges": {"bottom": {"nodes": ["A", "C"]}}}})",
     "/model/edges/bottom/nodes/1: no side of a block connects the previous node with this one"},
    {"ring", R"({"model": {"edges": {"bottom": {"nodes": ["A", "A"]}}}})",
     "/model/edges/bottom/nodes/1: this node equals the previous one"},
    {"ring", R"({"model": {"edges": {"again": {"nodes": ["B", "C"]}}}})",
     "already belongs to an edge"},
    {"ring", R"({"model": {"edges": {"A": {"nodes": ["C", "D"]}}}})",
     "/model/edges/A: a node has the same name as this edge"},
    {"ring", R"({"model": {"edges": {"outer": {"ellipse": {"center_m": [0, 0],
        "semi_axes_m": [2, 2]}}}}})",
     "/model/edges/outer: expected at most one of 'ellipse' and 'circle'"},
    {"ring", R"({"model": {"supports": {"innner": ["x"]}}})",
     "/model/supports/innner: expected the name of a node or edge (got 'innner')"},
    {"ring", R"({"model": {"supports": {"left": ["rotation"]}}})",
     "/model/supports/left: an edge cannot support 'rotation'"},
    {"ring", R"({"model": {"plates": {"ring": {"blocks": {"b": {
        "corners": ["A", "D", "C", "B"]}}}}}})",
     "/model/plates/ring/blocks/b/corners: expected the corners of a convex quadrilateral"},
    {"ring", R"({"model": {"plates": {"ring": {"triangles": [["A", "B", "C"]]}}}})",
     "/model/plates/ring: expected exactly one of 'triangles' and 'blocks'"},
    {"ring", R"({"model": {"nodes": {"M": [1.4, 1.4]}}})",
     "/model/nodes/M: the node (1.4, 1.4) m is connected to nothing"},
    {"ring", R"({"model": {"nodes": {"E": [3, 0], "F": [3, 3]}, "plates": {"ring": {"blocks": {
        "c": {"corners": ["B", "E", "F", "C"], "cells": [1, 3]}}}}}})",
     "/model/plates/ring/blocks/c: two blocks with a common side require the same nodes"},
    {"ring", R"({"model": {"nodes": {"E": [3, 0], "F": [3, 3]}, "plates": {"ring": {"blocks": {
        "c": {"corners": ["B", "E", "F", "C"], "cells": [1, 2]}}}}}})",
     "/model/loads/p/edge: a loaded edge requires a plate on one side only"},
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
     "/model/manipulator: the model is invalid: "},
    {"robot", R"({"model": {"manipulator": {"base_m": [[0, 0], [1, 0], [0, 1]]}}})",
     "/model/manipulator: expected either 'base_side_m' or 'base_m' (got both"},
    {"robot", R"({"model": {"elements": 8}})", "/model/manipulator/links"},
    {"robot", R"({"model": {"nodes": {"P": [0, 0]}}})", "/model/nodes/P: the manipulator already"},
    {"motion", R"({"model": {"trajectory": {"line": null, "spline": {"points": 5, "step_s": 0.1,
        "knots": [{"time_s": 0, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.1, "x_m": 0.26, "y_m": 0.144, "phi_rad": 0},
        {"time_s": 0.2, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0}]}}}})",
     "/model/trajectory/spline: expected a valid trajectory: the time"},
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
  const auto message = testing::input_error_message([&] { (void)testing::analyze_json(json); });
  BOOST_TEST(contains(message, refusal.message), message);
}

const auto kRefusals = boost::unit_test::data::make(kModels) + kAnalyses + kMotions + kEffects;

}  // namespace

BOOST_AUTO_TEST_CASE(unchanged_cases_are_accepted) {
  for (const auto& [name, json] : cases())
    BOOST_TEST(
        testing::input_error_message([&json = json] { (void)testing::analyze_json(json); }) == "",
        name);
}

BOOST_DATA_TEST_CASE(invalid_case_is_refused, kRefusals, refusal) {
  check(refusal);
}

BOOST_AUTO_TEST_SUITE_END()
