#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <cmath>
#include <numbers>

#include "solver/large/equilibrium.h"
#include "solver/large/joints.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/large_models.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(large_statics)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;
using boost::test_tools::tolerance;

constexpr double kPi = std::numbers::pi;

/// Returns the tip motion (x, y, rotation) at the last point of a path.
Vector3d tip(const GeometricallyExactSystem& system, const StaticPath& path) {
  return node_motion(system, path.points.back().state.q).row(1).transpose();
}

struct Elastica {
  double load, transverse, shortening, angle;
};

/// Exact tip motion of a cantilever under a transverse load P L^2 / EI, from elliptic integrals.
constexpr Elastica kSmall{1, .301720773799814, .0564332362833769, .461351949711879};
constexpr Elastica kLarge{10, .810609024880296, .554995597753751, 1.43028553880386};

double elastica_error(const Elastica& exact, Index elements, double angle = 0) {
  Model model = elastica(elements, angle);
  const Vector2d along(std::cos(angle), std::sin(angle)), up(-along.y(), along.x());
  model.loads = {{1, {exact.load * up.x(), exact.load * up.y(), 0}}};
  const GeometricallyExactSystem system(model);
  const StaticPath path = follow_static_path(system);
  BOOST_REQUIRE(path.outcome.solved());
  const Vector3d moved = tip(system, path);
  return std::max({std::abs(up.dot(moved.head<2>()) - exact.transverse),
                   std::abs(-along.dot(moved.head<2>()) - exact.shortening),
                   std::abs(moved[2] - exact.angle)});
}

/// Returns the equilibrium of the elastica under a force at its tip, approximated by
/// `estimate_large_statics`.
StaticSolution estimate_equilibrium(const Vector2d& force) {
  Model model = elastica(8);
  model.loads = {{1, {force.x(), force.y(), 0}}};
  return estimate_large_statics(model);
}

}  // namespace

BOOST_AUTO_TEST_CASE(estimate_of_a_stable_state_uses_two_factorizations) {
  const double critical = kPi * kPi / 4;  // buckling value of P L^2 / EI
  BOOST_TEST(estimate_equilibrium({0, 0.1}).counters.factorizations == 2);
  BOOST_TEST(estimate_equilibrium({-0.9 * critical, 0}).counters.factorizations == 2);
  BOOST_TEST(estimate_equilibrium({-1.1 * critical, 0}).counters.factorizations > 2);
  BOOST_TEST(estimate_equilibrium({-0.9 * critical, 0.1}).counters.factorizations > 2);
  const StaticSolution found = estimate_equilibrium({0, kLarge.load});
  BOOST_REQUIRE(found.outcome.solved());
  BOOST_TEST(found.displacement(1, 1) == kLarge.transverse, tolerance(2e-6));
  BOOST_TEST(found.displacement(1, 2) == kLarge.angle, tolerance(2e-6));
}

BOOST_AUTO_TEST_CASE(tip_errors_of_turned_beams_fall_with_order_6) {
  for (const double angle : {0.7, -2.9}) {
    const double coarse = elastica_error(kLarge, 6, angle);
    BOOST_TEST(observed_order(coarse, elastica_error(kLarge, 12, angle)) > 5.8);
  }
}

// Tests that round-off of a fine mesh does not limit the load steps. Otherwise the path of
// equilibria would have hundreds of points instead of 10.
BOOST_AUTO_TEST_CASE(round_off_of_a_fine_mesh_shortens_no_step) {
  Model model = elastica(1024);
  model.loads = {{1, {0, kSmall.load, 0}}};
  const GeometricallyExactSystem system(model);
  std::fesetround(FE_UPWARD);  // perturbs the tangent: Newton corrections shrink only 60-fold
  StaticPathOptions options;
  options.max_points = 20;
  const StaticPath path = follow_static_path(system, options);
  std::fesetround(FE_TONEAREST);
  BOOST_REQUIRE(path.outcome.solved());
  // The limit exceeds 10 * 3 N * 2 eps, with N elements and 3 N coordinates.
  BOOST_TEST(std::abs(tip(system, path)[1] - kSmall.transverse) < 2e-11);
}

BOOST_AUTO_TEST_CASE(newton_corrections_shrink_quadratically) {
  Model model = elastica(10);
  model.members[0].axially_flexible = true;
  LargeMotionModel follower;
  follower.follower_loads = {{1, {-0.3, 0.8, 0.2}}};
  const GeometricallyExactSystem system(model, follower);
  Equilibrium equilibrium(system);
  State state = system.reference_state();
  const NewtonResult result = equilibrium.solve(state, 1);
  BOOST_REQUIRE(result.outcome.solved());
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < result.correction.size(); ++i) {
    const double now = result.correction[i], next = result.correction[i + 1];
    if (now > 0.1 || next < 1e-13) continue;
    BOOST_TEST(next < 10 * now * now);
    ++pairs;
  }
  BOOST_TEST(pairs >= 1);
}

// A straight column under a follower load has no static instability at any load (M. Beck, ZAMP 3,
// 1952).
BOOST_AUTO_TEST_CASE(follower_load_converges_in_any_unit_and_direction) {
  for (const double stiffness : {1e-10, 1e5, 1e20})
    for (const double angle : {0.1, 0.36, 1.4}) {
      Model model = elastica(16, angle);
      model.members[0].section.EI = stiffness;
      LargeMotionModel follower;
      const Vector2d force = -24 * stiffness * Vector2d(std::cos(angle), std::sin(angle));
      follower.follower_loads = {{1, {force.x(), force.y(), 0}}};
      const StaticPath path = follow_static_path(GeometricallyExactSystem(model, follower));
      BOOST_TEST(path.outcome.solved(), path.outcome.reason);
    }
}

BOOST_AUTO_TEST_CASE(section_forces_balance_the_loads_in_the_bent_shape) {
  Model model = elastica(12);
  model.members[0].axially_flexible = true;
  model.members[0].load = {0.4, -1.5};
  model.loads = {{1, {1, 2, 0.3}}};
  const StaticSolution found = solve_large_statics(model);
  BOOST_REQUIRE(found.outcome.solved());
  const Eigen::RowVector3d reaction = found.reaction.row(0);
  BOOST_TEST((reaction.head<2>() + Eigen::RowVector2d(1.4, 0.5)).norm() < 1e-11);
  BOOST_TEST((found.resultant_start.row(0) + reaction).norm() < 1e-11);
  const Vector2d tip_force = rotated(Vector2d(1, 2), -found.displacement(1, 2));
  BOOST_TEST(
      (found.resultant_end.row(0) - Eigen::RowVector3d(tip_force.x(), tip_force.y(), 0.3)).norm() <
      1e-11);
}

BOOST_AUTO_TEST_CASE(mechanism_is_reported_as_a_free_motion) {
  // In addition, a path of equilibria without coordinates has one point.
  Model model = beam(unit_section(), 1, 2);
  model.supports = {pin(0)};
  model.loads = {{1, {0, 1, 0}}};
  const StaticPath path = follow_static_path(GeometricallyExactSystem(model));
  BOOST_TEST((path.outcome.status == Status::singular));
  BOOST_TEST(path.outcome.reason.find("free motion") != std::string::npos);
  Model fixed;
  fixed.nodes = {{"A", Vector2d(0, 0)}};
  fixed.supports = {clamp(0)};
  BOOST_TEST(follow_static_path(GeometricallyExactSystem(fixed)).points.size() == 1U);
}

BOOST_AUTO_TEST_SUITE_END()
