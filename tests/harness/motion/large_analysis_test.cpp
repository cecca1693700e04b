#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(large_analysis)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;
using boost::test_tools::tolerance;
using testing::complaint;
using testing::contains;
using testing::only;
using testing::result_of;

namespace {

/// A crank of 1 m, a rod of 2 m and a slider that it moves along x.
Json slider_crank() {
  return Json::parse(R"({
    "id": "slider-crank", "title": "A slider-crank",
    "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
      "sections": {"bar": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}},
      "nodes": {"O": [0, 0], "A": [0, 1], "S": [1.7320508075688772, 0]},
      "members": {
        "crank": {"nodes": ["O", "A"], "section": "bar"},
        "rod": {"nodes": ["A", "S"], "section": "bar", "ends": ["hinged", "hinged"]}
      },
      "supports": {"O": ["x", "y"]},
      "sliders": {"S": {"node": "S", "direction_rad": 0}},
      "loads": {"push": {"node": "S", "force_N": [-1000, 0]}}
    },
    "analysis": {"large-motion": {
      "end_time_s": 1, "step_s": 0.01,
      "drives": {"motor": {"node": "O", "motion": "rotation",
                           "law": {"rest_to_rest": {"travel": 1, "duration_s": 1}}}}
    }}
  })");
}

/// The paper's manipulator with hinged elbows and a rigid platform, one element a link.
Json hinged_manipulator() {
  return Json::parse(R"({
    "id": "hinged", "title": "Hinged elbows", "extends": "table-1.json",
    "model": {"manipulator": {"joints": {"elbow": "hinged"}, "platform": {"kind": "rigid"},
                              "links": {"elements": 1}}},
    "analysis": {"large-motion": {"end_time_s": 0.1, "step_s": 0.005, "nodes": ["A1", "B1", "P"]}}
  })");
}

/// From a pose on, at constant speed for 0.1 s.
Json tracking(const char* trajectory) {
  Json json = hinged_manipulator();
  json["model"]["pose"] = nullptr;
  json["model"]["trajectory"] = Json::parse(trajectory);
  json["analysis"]["large-motion"]["track"] = "angles";
  return json;
}

constexpr const char* kStraightSpline = R"({"spline": {"points": 2, "step_s": 0.1, "knots": [
  {"time_s": 0, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
  {"time_s": 0.05, "x_m": 0.255, "y_m": 0.149, "phi_rad": 0.01},
  {"time_s": 0.1, "x_m": 0.26, "y_m": 0.154, "phi_rad": 0.02}]}})";

}  // namespace

BOOST_AUTO_TEST_CASE(small_loads_give_what_linear_statics_gives) {
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {0, 0.1};
  const AnalysisResult linear = result_of(json);
  json["analysis"] = {{"large-statics", Json::object()}};
  const AnalysisResult exact = result_of(json);
  for (const char* name : {"displacement_y_m:B", "rotation_rad:B", "reaction_y_N:A",
                           "reaction_moment_N_m:A", "bending_moment_N_m:AB.start"}) {
    BOOST_TEST(only(exact, name) == only(linear, name), tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(each_load_factor_has_its_number) {
  Json json = testing::cantilever();
  json["analysis"] = {{"large-statics", {{"load_factors", {1, 100, 10000}}}}};
  const AnalysisResult result = result_of(json);
  const auto& moved = result.quantities.at("displacement_y_m:B").values;
  BOOST_REQUIRE(moved.size() == 3U);
  BOOST_TEST(moved[1] < 100 * moved[0]);
  BOOST_TEST(moved[2] < 2);
  BOOST_TEST(result.quantities.at("load_factor").values[2] == 10000);
}

BOOST_AUTO_TEST_CASE(a_slider_crank_turns_and_its_slider_stays_on_the_line) {
  const AnalysisResult result = result_of(slider_crank());
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  for (const double y : result.quantities.at("position_y_m:S").values) {
    BOOST_TEST(std::abs(y) < 1e-12);
  }
  // The crank has turned by 1 rad to the left of upright; links stretch and bend by 1e-4 at most.
  const double angle = std::numbers::pi / 2 + 1;
  const double x = std::cos(angle) + std::sqrt(4 - std::sin(angle) * std::sin(angle));
  BOOST_TEST(std::abs(result.quantities.at("position_x_m:S").values.back() - x) < 1e-3);
  BOOST_TEST(only(result, "constraint_residual") < 1e-12);
}

BOOST_AUTO_TEST_CASE(linear_statics_knows_sliders_and_pins) {
  Json json = slider_crank();
  json["analysis"] = {{"statics", Json::object()}};
  json["model"]["supports"]["O"] = {"x", "y", "rotation"};
  const AnalysisResult linear = result_of(json);
  BOOST_REQUIRE(linear.outcome.solved());
  BOOST_TEST(only(linear, "displacement_y_m:S") == 0.0);
  json["model"]["loads"]["push"]["force_N"] = {-1, 0};
  const double moved = only(result_of(json), "displacement_x_m:S");
  json["analysis"] = {{"large-statics", Json::object()}};
  BOOST_TEST(only(result_of(json), "displacement_x_m:S") == moved, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(linear_analyses_refuse_what_only_large_motion_has) {
  Json json = slider_crank();
  json["analysis"] = {{"statics", Json::object()}};
  json["model"]["axial_springs"] = {{"k", {{"nodes", {"O", "S"}}, {"stiffness_N_per_m", 1000}}}};
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }), "large-statics or large-motion"));
}

BOOST_AUTO_TEST_CASE(wrong_names_and_distant_pins_are_told_with_their_place) {
  Json json = slider_crank();
  json["analysis"]["large-motion"]["drives"]["motor"]["node"] = "A ";
  const std::string wrong = complaint([&] { (void)result_of(json); });
  BOOST_TEST(contains(wrong, "/analysis/large-motion/drives/motor/node"), wrong);
  BOOST_TEST(contains(wrong, "did you mean 'A'"), wrong);
  json = slider_crank();
  json["model"]["pins"] = {{"p", {{"nodes", {"A", "S"}}}}};
  const std::string apart = complaint([&] { (void)result_of(json); });
  BOOST_TEST(contains(apart, "/model/pins/p/nodes"), apart);
}

BOOST_AUTO_TEST_CASE(steps_that_do_not_converge_name_the_step_and_the_time) {
  Json json = slider_crank();
  json["analysis"]["large-motion"]["steps"] = 3;
  const AnalysisResult result = result_of(json);
  BOOST_TEST((result.outcome.status == Status::not_converged));
  BOOST_TEST(contains(result.outcome.reason, "step 4 at time 0.03 s"), result.outcome.reason);
}

// Differences about the first instant looked for poses before the table.
BOOST_AUTO_TEST_CASE(a_spline_is_tracked_from_its_first_instant_to_its_last) {
  const AnalysisResult spline = result_of(tracking(kStraightSpline));
  BOOST_REQUIRE_MESSAGE(spline.outcome.solved(), spline.outcome.reason);
  const AnalysisResult line = result_of(tracking(R"({"line": {
    "from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
    "to": {"x_m": 0.26, "y_m": 0.154, "phi_rad": 0.02},
    "duration_s": 0.1, "points": 2, "step_s": 0.1}})"));
  for (const char* name : {"deflection_x_m:P", "deflection_y_m:P"}) {
    const std::vector<double>& on_line = testing::values(line, name);
    for (std::size_t i = 0; i < on_line.size(); ++i)
      BOOST_TEST(std::abs(testing::values(spline, name)[i] - on_line[i]) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(tracking_ends_no_later_than_its_spline) {
  Json json = tracking(kStraightSpline);
  json["analysis"]["large-motion"]["end_time_s"] = 0.11;
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }),
                      "/analysis/large-motion/end_time_s: expected a time on the path"));
}

BOOST_AUTO_TEST_CASE(where_only_hinges_meet_there_is_no_rotation_to_keep_or_to_see_from) {
  const AnalysisResult result = result_of(slider_crank());
  BOOST_TEST(result.quantities.contains("rotation_rad:A"));
  BOOST_TEST(!result.quantities.contains("rotation_rad:S"));
  const auto complaint_about = [](const char* key, const Json& value) {
    Json json = slider_crank();
    json["analysis"]["large-motion"][key] = value;
    return complaint([&] { (void)result_of(json); });
  };
  for (const auto& [message, place] :
       {std::pair{complaint_about("relative_to", "S"), "/relative_to"},
        std::pair{complaint_about("angles", {{"a", {{"node", "S"}}}}), "/angles/a/node"},
        std::pair{complaint_about("angles", {{"a", {{"node", "A"}, {"from", "S"}}}}),
                  "/angles/a/from"}}) {
    BOOST_TEST(contains(message, "/analysis/large-motion" + std::string(place) +
                                     ": expected a node that has a rotation"),
               message);
  }
}

BOOST_AUTO_TEST_CASE(a_drive_replaces_the_lock_of_an_actuator) {
  Json json = hinged_manipulator();
  json["model"]["manipulator"]["material"]["E_Pa"] = 6.9e14;  // the link turns as one
  const Json law = {{"rest_to_rest", {{"travel", 0.05}, {"duration_s", 0.1}}}};
  json["analysis"]["large-motion"]["drives"] = {
      {"motor", {{"node", "A1"}, {"motion", "rotation"}, {"law", law}}}};
  const AnalysisResult result = result_of(json);
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  BOOST_TEST(testing::values(result, "rotation_rad:A1").back() == 0.05, tolerance(1e-9));
  BOOST_TEST(testing::values(result, "rotation_rad:B1").back() == 0.05, tolerance(1e-3));
}

// It turned a node to which no link is joined, and nothing else moved.
BOOST_AUTO_TEST_CASE(a_history_with_a_jump_or_beside_a_ramp_is_refused) {
  Json json = slider_crank();
  Json& motion = json["analysis"]["large-motion"];
  motion["load_history"] = {{"time_s", {0.1, 0.1}}, {"factor", {0, 1}}};
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }), "/time_s/1: expected no jump"));
  motion["load_history"]["time_s"][1] = 0.2;
  motion["load_ramp_s"] = 0.1;
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }), "without 'load_ramp_s'"));
}

BOOST_AUTO_TEST_CASE(a_drive_that_moves_nothing_is_refused) {
  Json json = hinged_manipulator();
  const Json law = {{"constant_speed", {{"speed_per_s", 1}}}};
  json["model"]["manipulator"]["joints"]["active"] = "free";
  json["analysis"]["large-motion"]["drives"] = {
      {"motor", {{"node", "A1"}, {"motion", "rotation"}, {"law", law}}}};
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }),
                      "/analysis/large-motion/drives/motor: expected an actuator that is locked"));
  json = slider_crank();
  json["model"]["members"]["crank"]["ends"] = {"hinged", "hinged"};
  const std::string nothing = complaint([&] { (void)result_of(json); });
  BOOST_TEST(contains(nothing, "/analysis/large-motion/drives/motor: "), nothing);
  BOOST_TEST(contains(nothing, "moves nothing"), nothing);
}

BOOST_AUTO_TEST_CASE(steps_beyond_number_are_refused_before_the_first) {
  Json json = slider_crank();
  json["analysis"]["large-motion"]["step_s"] = 1e-12;
  json["analysis"]["large-motion"]["output_step_s"] = 0.01;
  const std::string refusal = complaint([&] { (void)result_of(json); });
  BOOST_TEST(contains(refusal, "/analysis/large-motion/step_s: expected at most ten million steps"),
             refusal);
}

namespace {

/// A free mass of 1 kg under 2 N times a history.
Json pushed(const Json& times, const Json& factors) {
  Json json = Json::parse(R"({
    "id": "pushed", "title": "A mass that is pushed",
    "model": {"nodes": {"A": [0, 0]}, "point_masses": {"p": {"node": "A", "mass_kg": 1}},
              "loads": {"t": {"node": "A", "force_N": [2, 0]}}},
    "analysis": {"large-motion": {"end_time_s": 1, "step_s": 0.1, "spectral_radius": 1}}
  })");
  json["analysis"]["large-motion"]["load_history"] = {{"time_s", times}, {"factor", factors}};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_end_where_a_load_bends_and_only_there) {
  Json times = Json::array(), constant = Json::array(), zigzag = Json::array();
  for (int i = 0; i <= 2000; ++i) {
    times.push_back(i / 2000.0);
    constant.push_back(1);
    zigzag.push_back(i % 2);
  }
  BOOST_TEST(only(result_of(pushed(times, constant)), "steps") == 10);
  const AnalysisResult bent = result_of(pushed(times, zigzag));
  BOOST_REQUIRE_MESSAGE(bent.outcome.solved(), bent.outcome.reason);
  BOOST_TEST(only(bent, "steps") == 2000);
  BOOST_TEST(testing::values(bent, "velocity_x_m_per_s:A").back() == 1, tolerance(1e-12));
}

// By similarity: the times of a length L go with its root.
BOOST_AUTO_TEST_CASE(a_stretched_rod_is_refused_whatever_its_length) {
  for (const double length : {1e-3, 1.0, 1e3}) {
    Json json = Json::parse(R"({
      "id": "pendulum", "title": "A pendulum",
      "model": {"nodes": {"O": [0, 0], "B": [1, 0]},
                "rigid_bodies": {"rod": {"reference": "O", "nodes": ["B"]}},
                "point_masses": {"bob": {"node": "B", "mass_kg": 1}},
                "supports": {"O": ["x", "y"]}, "gravity_m_s2": [0, -9.81]},
      "analysis": {"large-motion": {"extrapolated": true}}
    })");
    json["model"]["nodes"]["B"] = {-length, 0};
    json["analysis"]["large-motion"]["step_s"] = 0.25 * std::sqrt(length);
    json["analysis"]["large-motion"]["end_time_s"] = 10 * std::sqrt(length);
    const AnalysisResult result = result_of(json);
    BOOST_TEST((result.outcome.status == Status::not_converged));
    BOOST_TEST(contains(result.outcome.reason, "too long to be extrapolated"),
               result.outcome.reason);
  }
}

namespace {

/// A rigid crank about O with masses at B and C.
Json crank() {
  return Json::parse(R"({
    "id": "crank", "title": "A rigid crank",
    "model": {
      "nodes": {"O": [0, 0], "B": [3, 4], "C": [6, 0]},
      "rigid_bodies": {"crank": {"reference": "O", "nodes": ["B", "C"]}},
      "point_masses": {"B": {"node": "B", "mass_kg": 1}, "C": {"node": "C", "mass_kg": 2}},
      "supports": {"O": ["x", "y"]}
    },
    "analysis": {"large-motion": {"end_time_s": 0.1, "step_s": 0.01}}
  })");
}

}  // namespace

// v_y = -3/4 v_x in B, and C moves along y alone.
BOOST_AUTO_TEST_CASE(an_admissible_velocity_is_suggested_that_is_admitted) {
  Json json = crank();
  Json& given = json["analysis"]["large-motion"]["initial_velocities"];
  given["B"] = {{"x_m_per_s", 1}, {"y_m_per_s", 0.9}};
  const std::string reason = result_of(json).outcome.reason;
  BOOST_TEST(reason ==
             "the constraints do not let node B start with 1 m/s along x: with the other given "
             "velocities, -1.2 m/s is admissible");
  given["B"]["x_m_per_s"] = -1.2;
  BOOST_TEST(result_of(json).outcome.solved());
  given["C"]["y_m_per_s"] = 5;
  BOOST_TEST(contains(result_of(json).outcome.reason,
                      "nor do they admit the other given velocities together"));
  given = {{"C", {{"x_m_per_s", 1}}}};
  BOOST_TEST(contains(result_of(json).outcome.reason, ": 0 m/s is admissible"));
}

BOOST_AUTO_TEST_CASE(drives_that_contradict_each_other_are_named) {
  Json json = crank();
  const auto drive = [](const char* node, const char* motion, const Json& law) {
    return Json{{"node", node}, {"motion", motion}, {"law", law}};
  };
  const auto at = [](double speed) { return Json{{"constant_speed", {{"speed_per_s", speed}}}}; };
  const auto travel = [](double way) {
    return Json{{"rest_to_rest", {{"travel", way}, {"duration_s", 0.1}}}};
  };
  const auto reason = [&](const Json& first, const Json& second, const char* kind) {
    Json options = {{"drives", {{"a", first}, {"b", second}}}};
    if (kind == std::string("large-motion"))
      options.update({{"end_time_s", 0.1}, {"step_s", 0.01}});
    json["analysis"] = {{kind, options}};
    return result_of(json).outcome.reason;
  };
  const std::string both = "do not admit the motion of a, b";
  BOOST_TEST(contains(reason(drive("O", "rotation", at(1)), drive("C", "y", at(2)), "large-motion"),
                      both));
  BOOST_TEST(contains(
      reason(drive("O", "rotation", travel(1)), drive("C", "y", travel(2)), "large-motion"), both));
  BOOST_TEST(contains(
      reason(drive("O", "rotation", at(1)), drive("C", "y", at(2)), "large-statics"), both));
  BOOST_TEST(reason(drive("O", "rotation", at(1)), drive("C", "rotation", at(1)), "large-motion") ==
             "");
}

BOOST_AUTO_TEST_SUITE_END()
