#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(large_stability)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

constexpr double kPi = std::numbers::pi;

/// A column along x under a compressive end load of 1, so that load factors are loads.
Model column(Index elements) {
  Model model = elastica(elements);
  model.loads = {{1, {-1, 0, 0}}};
  return model;
}

double critical_load(const Model& model, double target) {
  const GeometricallyExactSystem system(model);
  StaticPathOptions options;
  options.target = target;
  const StaticPath path = follow_static_path(system, options);
  BOOST_REQUIRE(path.outcome.solved());
  BOOST_REQUIRE(path.events.size() == 1U);
  BOOST_TEST((path.events[0].kind == PathEvent::Kind::bifurcation));
  BOOST_TEST(path.points.front().unstable_directions == 0);
  BOOST_TEST(path.points.back().unstable_directions == 1);
  return path.events[0].load;
}

/// Two bars of stiffness EA meeting at an apex of height H over half-span B, pushed down.
Model shallow_truss(double B, double H, double EA) {
  Model model;
  model.nodes = {{"left", {-B, 0}}, {"apex", {0, H}}, {"right", {B, 0}}};
  Section section = unit_section(EA);
  section.EI = 0;
  for (const auto& [a, b] : {std::pair<Index, Index>{0, 1}, std::pair<Index, Index>{2, 1}}) {
    Member bar = member("bar", a, b, section);
    bar.ends = {MemberEnd{EndFixity::hinged, 0, 0}, MemberEnd{EndFixity::hinged, 0, 0}};
    model.members.push_back(bar);
  }
  model.supports = {pin(0), pin(2)};
  model.loads = {{1, {0, -1, 0}}};
  return model;
}

/// A shallow arch of eight straight pieces on hinges, pushed down at its crown and a little across.
Model shallow_arch(double across) {
  Model model;
  Section section = unit_section(1e4);
  section.EI = 1e4 / 12;
  for (Index i = 0; i <= 8; ++i) {
    const double angle = std::asin(50 / 252.5) * static_cast<double>(i - 4) / 4;
    model.nodes.push_back({"n", {252.5 * std::sin(angle), 252.5 * std::cos(angle) - 247.5}});
    if (i == 0) continue;
    model.members.push_back(member("piece", i - 1, i, section));
    model.members.back().elements = 2;
  }
  model.supports = {pin(0), pin(8)};
  model.loads = {{4, {across, -1, 0}}};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(columns_buckle_at_eulers_loads) {
  BOOST_TEST(std::abs(critical_load(column(32), 5) / (kPi * kPi / 4) - 1) < 1e-9);
  Model pinned = column(32);
  pinned.supports = {pin(0), roller(1)};
  BOOST_TEST(std::abs(critical_load(pinned, 20) / (kPi * kPi) - 1) < 1e-9);
  Model propped = column(32);
  propped.supports = {clamp(0), roller(1)};
  const double root = 4.49340945790906418;
  BOOST_TEST(std::abs(critical_load(propped, 30) / (root * root) - 1) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_column_follows_its_buckled_branch_as_the_elastica_does) {
  // Tip angle in degrees, load over Euler's, lateral and axial tip displacement over the length:
  // elliptic integrals; the loads of ANSYS VM136 are four of them.
  const std::vector<std::array<double, 4>> exact = {
      {20, 1.01539686554, .219413042396, -.0302690926365},
      {40, 1.0636632664, .422240340121, -.118796488274},
      {60, 1.15171962047, .593207646165, -.258980393924},
      {80, 1.29388932388, .719497104731, -.440604081049},
      {100, 1.51838879329, .791539496537, -.651010699585},
      {120, 1.88480086898, .803170990007, -.876840027595}};
  for (const auto& [angle, load, lateral, axial] : exact) {
    const GeometricallyExactSystem system(column(24));
    StaticPathOptions options;
    options.target = load * kPi * kPi / 4;
    options.switch_branch = true;
    const StaticPath path = follow_static_path(system, options);
    BOOST_REQUIRE(path.outcome.solved());
    const Eigen::RowVector3d tip = node_motion(system, path.points.back().state.q).row(1);
    const double sensitivity = angle < 30 ? 1e-9 : 1e-10;
    BOOST_TEST(std::abs(std::abs(tip[2]) * 180 / kPi - angle) < 100 * sensitivity);
    BOOST_TEST(std::abs(std::abs(tip[1]) - lateral) < sensitivity);
    BOOST_TEST(std::abs(tip[0] - axial) < sensitivity);
    BOOST_TEST(path.points.back().unstable_directions == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_path_does_not_step_over_its_target) {
  // Newton on the target itself may fail from far away; the step must then be cut, not taken.
  const GeometricallyExactSystem system(column(24));
  StaticPathOptions options;
  options.target = kPi * kPi / 2;
  options.switch_branch = true;
  const StaticPath path = follow_static_path(system, options);
  BOOST_REQUIRE(path.outcome.solved());
  BOOST_TEST(path.points.back().state.load == options.target);
}

BOOST_AUTO_TEST_CASE(a_shallow_truss_snaps_through_its_limit_points) {
  const double B = 1, H = 0.2, EA = 100;
  const double L = std::hypot(B, H);
  // Engineering strain: P(w) = 2 EA (1/l - 1/L) z, z = H - w, l^2 = B^2 + z^2; dP/dz = 0 where
  // l^3 = L B^2.
  const double l = std::cbrt(L * B * B), z = std::sqrt(l * l - B * B);
  const double limit = 2 * EA * (1 / l - 1 / L) * z;
  const GeometricallyExactSystem system(shallow_truss(B, H, EA));
  StaticPathOptions options;
  options.target = 2 * limit;
  options.first_step = limit / 20;
  const StaticPath path = follow_static_path(system, options);
  BOOST_REQUIRE(path.outcome.solved());
  BOOST_REQUIRE(path.events.size() == 2U);
  BOOST_TEST((path.events[0].kind == PathEvent::Kind::limit_point));
  BOOST_TEST((path.events[1].kind == PathEvent::Kind::limit_point));
  BOOST_TEST(std::abs(path.events[0].load / limit - 1) < 1e-9);
  BOOST_TEST(std::abs(path.events[1].load / limit + 1) < 1e-9);
  const double apex = node_motion(system, path.points.back().state.q)(1, 1);
  const double below = -(H + apex), length = std::hypot(B, below);
  BOOST_TEST(std::abs(2 * EA * (1 / L - 1 / length) * below / (2 * limit) - 1) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_path_does_not_change_over_to_a_branch_that_passes_near_by) {
  for (const double across : {0.05, 0.01, 0.002}) {
    const GeometricallyExactSystem system(shallow_arch(across));
    StaticPathOptions options;
    options.first_step = 0.05;
    options.target = 0.8;
    const StaticPath path = follow_static_path(system, options);
    BOOST_REQUIRE(path.outcome.solved());
    BOOST_REQUIRE(path.events.size() == 2U);
    BOOST_TEST((path.events[0].kind == PathEvent::Kind::limit_point));
    BOOST_TEST((path.events[1].kind == PathEvent::Kind::limit_point));
    BOOST_TEST(path.points.back().unstable_directions == 0);  // it hangs
    BOOST_TEST(node_motion(system, path.points.back().state.q)(4, 1) < -10);
  }
}

BOOST_AUTO_TEST_CASE(a_path_that_cannot_go_on_says_where_it_stopped) {
  const GeometricallyExactSystem system(column(8));
  StaticPathOptions options;
  options.target = 100;
  options.max_points = 5;
  const StaticPath path = follow_static_path(system, options);
  BOOST_TEST((path.outcome.status == Status::not_converged));
  BOOST_TEST(path.outcome.reason.find("load factor") != std::string::npos);
  BOOST_TEST(path.outcome.reason.find("residual") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
