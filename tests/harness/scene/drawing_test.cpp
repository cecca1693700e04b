#include "harness/scene/drawing.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(drawing)

using namespace trammel;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

std::vector<Eigen::VectorXd> wave(double periods) {
  std::vector<Eigen::VectorXd> q;
  for (int i = 0; i <= 960; ++i)
    q.emplace_back(Eigen::VectorXd::Constant(1, std::sin(2 * M_PI * periods * i / 960)));
  return q;
}

/// Returns a manipulator that moves along a line of 10 mm in 0.1 s, with a force at P.
Json manipulator_on_line(const Json& analysis) {
  Json json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["trajectory"]["line"] =
      Json::parse(R"({"duration_s": 0.1, "points": 101, "step_s": 0.001,
        "from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0}, "to": {"x_m": 0.26, "y_m": 0.144, "phi_rad": 0}})");
  json["model"]["loads"]["F"] = {{"node", "P"}, {"force_N", {1, 0}}};
  json["analysis"] = analysis;
  return json;
}

/// Returns the value of the quantity `name` at the time of a drawn pose.
double at(const AnalysisResult& result, const std::string& name, const results::Pose& instant) {
  const std::vector<double>& time = values(result, "time_s");
  const auto found =
      std::ranges::min_element(time, {}, [&](double t) { return std::abs(t - *instant.time_s); });
  BOOST_TEST(*found == *instant.time_s, tolerance(1e-12));
  return values(result, name).at(static_cast<std::size_t>(found - time.begin()));
}

const std::vector<results::Pose>& drawn_instants(const AnalysisResult& result, std::size_t least) {
  BOOST_REQUIRE(result.drawing.has_value());
  BOOST_TEST_REQUIRE(result.drawing->poses.size() >= least);
  return result.drawing->poses;
}

constexpr std::size_t kP = 9;  ///< index of the platform's center among the nodes of a manipulator

}  // namespace

BOOST_AUTO_TEST_CASE(drawn_instants_resolve_fast_motions) {
  const std::vector<std::size_t> slow = samples_to_draw(wave(1), 20);
  BOOST_TEST(slow.size() == 48);
  BOOST_TEST(slow.front() == 0);
  BOOST_TEST(slow.back() == 960);
  const std::vector<std::size_t> fast = samples_to_draw(wave(48), 20);
  BOOST_TEST(fast.size() == 48);
  BOOST_TEST(fast.back() > 60);  // the drawn time span is at least three periods
  BOOST_TEST(fast.back() < 250);
  BOOST_TEST(samples_to_draw(wave(1), 1000).size() == 6);
  BOOST_TEST(samples_to_draw({Eigen::VectorXd::Zero(1)}, 20).empty());
  for (std::size_t k = 1; k < slow.size(); ++k) BOOST_TEST((slow[k] - slow[k - 1]) / 2 == 10U);
}

BOOST_AUTO_TEST_CASE(instant_along_a_path_is_drawn_with_its_deflection) {
  for (const Json& analysis :
       {Json{{"elastodynamics", {{"step_s", 0.001}, {"initial_state", "quasi-static"}}}},
        Json{{"statics", Json::object()}}, Json{{"kinematics", Json::object()}}}) {
    const AnalysisResult result = analyze_json(manipulator_on_line(analysis));
    const std::string deflection =
        analysis.contains("statics") ? "displacement_x_m:P" : "deflection_m:P";
    for (const results::Pose& instant : drawn_instants(result, 6)) {
      BOOST_TEST(instant.nodes.at(kP).first == 0.25 + 0.1 * *instant.time_s, tolerance(1e-12));
      BOOST_TEST(instant.label == time_label(*instant.time_s));
      if (analysis.contains("kinematics")) continue;
      BOOST_TEST_REQUIRE(result.drawing->forces.size() == 1U);
      BOOST_TEST(result.drawing->forces[0].node == kP);
      BOOST_TEST(result.drawing->forces[0].x == 10 + 1);
      const auto [x, y] = instant.displacement.at(kP);
      BOOST_TEST(
          (analysis.contains("statics") ? x : std::hypot(x, y)) == at(result, deflection, instant),
          tolerance(1e-9));
    }
    BOOST_TEST(drawn_instants(result, 6).back().time_s.value() == 0.1, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(poses_of_a_large_motion_are_drawn_at_their_positions) {
  const AnalysisResult result = analyze_json(Json::parse(R"({
    "id": "pendulum", "title": "A pendulum that is turned",
    "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
      "sections": {"bar": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}},
      "nodes": {"O": [0, 0], "A": [0, 1]},
      "members": {"crank": {"nodes": ["O", "A"], "section": "bar"}},
      "supports": {"O": ["x", "y"]}
    },
    "analysis": {"large-motion": {
      "end_time_s": 1, "step_s": 0.01, "nodes": ["A"],
      "drives": {"motor": {"node": "O", "motion": "rotation",
                           "law": {"rest_to_rest": {"travel": 1, "duration_s": 1}}}}
    }}
  })"));
  for (const results::Pose& instant : drawn_instants(result, 40))
    BOOST_TEST(instant.nodes.at(1).first == at(result, "position_x_m:A", instant), tolerance(1e-9));
  BOOST_TEST(drawn_instants(result, 40).back().time_s.value() == 1, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
