#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(large_analysis)

using namespace trammel;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// Returns the manipulator of Table 1 of Varalakshmi and Srinivas (2017), but with hinged elbows.
/// It has a rigid platform and one element per link.
Json hinged_manipulator() {
  return Json::parse(R"({
    "id": "hinged", "title": "Hinged elbows", "extends": "table-1.json",
    "model": {"manipulator": {"joints": {"elbow": "hinged"}, "platform": {"kind": "rigid"},
                              "links": {"elements": 1}}},
    "analysis": {"large-motion": {"end_time_s": 0.1, "step_s": 0.005, "nodes": ["A1", "B1", "P"]}}
  })");
}

/// Returns the hinged manipulator with joint angles that follow a trajectory of 0.1 s.
Json tracking_manipulator(const char* trajectory) {
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

BOOST_AUTO_TEST_CASE(time_step_that_does_not_converge_is_reported) {
  Json json = testing::slider_crank();
  json["analysis"]["large-motion"]["steps"] = 3;
  const AnalysisResult result = analyze_json(json);
  BOOST_TEST((result.outcome.status == Status::not_converged));
  BOOST_TEST(contains(result.outcome.reason, "step 4 at time 0.03 s"), result.outcome.reason);
}

// Tests joint angles that follow a spline path of the platform. Central differences at the first
// instant once required a pose before the spline's first knot.
BOOST_AUTO_TEST_CASE(spline_is_tracked_from_first_to_last_instant) {
  const AnalysisResult spline = analyze_json(tracking_manipulator(kStraightSpline));
  BOOST_REQUIRE_MESSAGE(spline.outcome.solved(), spline.outcome.reason);
  const AnalysisResult line = analyze_json(tracking_manipulator(R"({"line": {
    "from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
    "to": {"x_m": 0.26, "y_m": 0.154, "phi_rad": 0.02},
    "duration_s": 0.1, "points": 2, "step_s": 0.1}})"));
  for (const char* name : {"deflection_x_m:P", "deflection_y_m:P"}) {
    const std::vector<double>& on_line = testing::values(line, name);
    for (std::size_t i = 0; i < on_line.size(); ++i)
      BOOST_TEST(std::abs(testing::values(spline, name)[i] - on_line[i]) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(node_where_only_hinges_meet_has_no_rotation) {
  const AnalysisResult result = analyze_json(testing::slider_crank());
  BOOST_TEST(result.quantities.contains("rotation_rad:A"));
  BOOST_TEST(!result.quantities.contains("rotation_rad:S"));
}

BOOST_AUTO_TEST_CASE(prescribed_rotation_releases_the_locked_actuator) {
  Json json = hinged_manipulator();
  json["model"]["manipulator"]["material"]["E_Pa"] = 6.9e14;  // the link is nearly rigid
  const Json law = {{"rest_to_rest", {{"travel", 0.05}, {"duration_s", 0.1}}}};
  json["analysis"]["large-motion"]["drives"] = {
      {"motor", {{"node", "A1"}, {"motion", "rotation"}, {"law", law}}}};
  const AnalysisResult result = analyze_json(json);
  BOOST_REQUIRE_MESSAGE(result.outcome.solved(), result.outcome.reason);
  BOOST_TEST(testing::values(result, "rotation_rad:A1").back() == 0.05, tolerance(1e-9));
  BOOST_TEST(testing::values(result, "rotation_rad:B1").back() == 0.05, tolerance(1e-3));
}

namespace {

/// Returns a free mass of 1 kg under a force of 2 N times a load history.
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

BOOST_AUTO_TEST_CASE(slope_changes_of_the_load_are_ends_of_time_steps) {
  Json times = Json::array(), constant = Json::array(), zigzag = Json::array();
  for (int i = 0; i <= 2000; ++i) {
    times.push_back(i / 2000.0);
    constant.push_back(1);
    zigzag.push_back(i % 2);
  }
  BOOST_TEST(only(analyze_json(pushed(times, constant)), "steps") == 10);
  const AnalysisResult bent = analyze_json(pushed(times, zigzag));
  BOOST_REQUIRE_MESSAGE(bent.outcome.solved(), bent.outcome.reason);
  BOOST_TEST(only(bent, "steps") == 2000);
  BOOST_TEST(testing::values(bent, "velocity_x_m_per_s:A").back() == 1, tolerance(1e-12));
}

// Tests that the motion of a pendulum is refused if its time steps are too long. The step is
// proportional to the square root of the pendulum length, as is the period.
BOOST_AUTO_TEST_CASE(too_long_steps_are_refused_for_any_length) {
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
    const AnalysisResult result = analyze_json(json);
    BOOST_TEST((result.outcome.status == Status::not_converged));
    BOOST_TEST(contains(result.outcome.reason, "too long to be extrapolated"),
               result.outcome.reason);
  }
}

namespace {

/// Returns a rigid crank about O with masses at B and C.
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

// The kinematics of the crank require v_y = -3/4 v_x at B and v_x = 0 at C.
BOOST_AUTO_TEST_CASE(suggested_initial_velocity_obeys_the_constraints) {
  Json json = crank();
  Json& given = json["analysis"]["large-motion"]["initial_velocities"];
  given["B"] = {{"x_m_per_s", 1}, {"y_m_per_s", 0.9}};
  const std::string reason = analyze_json(json).outcome.reason;
  BOOST_TEST(reason ==
             "the constraints do not let node B start with 1 m/s along x: with the other given "
             "velocities, -1.2 m/s is admissible");
  given["B"]["x_m_per_s"] = -1.2;
  BOOST_TEST(analyze_json(json).outcome.solved());
  given["C"]["y_m_per_s"] = 5;
  BOOST_TEST(contains(analyze_json(json).outcome.reason,
                      "nor do the constraints admit the other given velocities"));
  given = {{"C", {{"x_m_per_s", 1}}}};
  BOOST_TEST(contains(analyze_json(json).outcome.reason, ": 0 m/s is admissible"));
}

BOOST_AUTO_TEST_CASE(contradicting_drives_are_named) {
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
    return analyze_json(json).outcome.reason;
  };
  const std::string both = "do not admit the prescribed motion of a, b";
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
