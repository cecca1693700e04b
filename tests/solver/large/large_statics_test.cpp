#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/large/equilibrium.h"
#include "solver/large/joints.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(large_statics)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

constexpr double kPi = std::numbers::pi;

/// Tip motion (x, y, rotation) of a solved path's last point.
Vector3d tip(const GeometricallyExactSystem& system, const StaticPath& path) {
  return node_motion(system, path.points.back().state.q).row(1).transpose();
}

struct Elastica {
  double load, transverse, shortening, angle;
};

/// Cantilever under a transverse tip load P L^2 / EI (Bisshopp and Drucker 1945), 15 digits by
/// elliptic integrals.
const std::vector<Elastica> kElastica = {
    {.2, .0663644821448305, .00264654834052277, .0996361630374019},
    {.5, .16214357565837, .0159189624708375, .244533647133218},
    {1, .301720773799814, .0564332362833769, .461351949711879},
    {1.5, .410978211248258, .107941500683559, .639539826150778},
    {2, .493457480396712, .160641720825167, .781749831556543},
    {3, .603253441129977, .254420184564187, .986016946711354},
    {4, .669964181277667, .328941242246846, 1.12123934748758},
    {5, .713791523611913, .38762836072443, 1.21536811761168},
    {6, .744571148889515, .434588828681905, 1.28369728580125},
    {7, .767369099740463, .472927428386337, 1.33495985747186},
    {8, .784982374953315, .504827732133532, 1.37443150670139},
    {9, .79905552747084, .531820562672527, 1.40546533362395},
    {10, .810609024880296, .554995597753751, 1.43028553880386},
    {15, .847715674332297, .635285780362085, 1.50184015417716}};

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

/// A tip moment that rolls the elastica up: one plain Newton solution for the whole load.
NewtonResult roll_up(double turns, Index elements, Vector3d& tip_motion) {
  Model model = elastica(elements);
  model.loads = {{1, {0, 0, 2 * kPi * turns}}};
  const GeometricallyExactSystem system(model);
  Equilibrium equilibrium(system);
  State state = system.reference_state();
  const NewtonResult result = equilibrium.solve(state, 1);
  tip_motion = node_motion(system, state.q).row(1).transpose();
  return result;
}

/// Of the elastica under a force at its tip.
StaticSolution estimate_of(const Vector2d& force) {
  Model model = elastica(8);
  model.loads = {{1, {force.x(), force.y(), 0}}};
  return estimate_large_statics(model);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_elastica_under_a_tip_load_agrees_to_eleven_digits) {
  for (const Elastica& exact : kElastica) BOOST_TEST(elastica_error(exact, 64) < 5e-12);
}

BOOST_AUTO_TEST_CASE(estimates_of_the_elastica_agree_to_six_digits) {
  for (const Elastica& exact : kElastica) {
    const StaticSolution found = estimate_of({0, exact.load});
    BOOST_REQUIRE(found.outcome.solved());
    BOOST_TEST(found.displacement(1, 1) == exact.transverse, boost::test_tools::tolerance(2e-6));
    BOOST_TEST(found.displacement(1, 2) == exact.angle, boost::test_tools::tolerance(2e-6));
  }
}

BOOST_AUTO_TEST_CASE(two_tangents_estimate_what_is_small_and_stable) {
  const double critical = kPi * kPi / 4;  // P L^2 / EI
  BOOST_TEST(estimate_of({0, 0.1}).counters.factorizations == 2);
  BOOST_TEST(estimate_of({-0.9 * critical, 0}).counters.factorizations == 2);
  BOOST_TEST(estimate_of({-1.1 * critical, 0}).counters.factorizations > 2);
  BOOST_TEST(estimate_of({-0.9 * critical, 0.1}).counters.factorizations > 2);
}

BOOST_AUTO_TEST_CASE(a_turned_elastica_is_as_exact) {
  BOOST_TEST(elastica_error(kElastica[12], 64, 0.7) < 1e-11);
  BOOST_TEST(elastica_error(kElastica[12], 64, -2.9) < 1e-11);
}

BOOST_AUTO_TEST_CASE(tip_errors_fall_with_order_6) {
  const Elastica exact{10, .810609024880296, .554995597753751, 1.43028553880386};
  const double observed = std::log2(elastica_error(exact, 6) / elastica_error(exact, 12));
  BOOST_TEST(observed > 5.8);
  BOOST_TEST(observed < 6.5);
}

BOOST_AUTO_TEST_CASE(rounding_of_a_fine_mesh_shortens_no_step) {  // 10 points; hundreds, if it did
  Model model = elastica(1024);
  model.loads = {{1, {0, kElastica[2].load, 0}}};
  const GeometricallyExactSystem system(model);
  std::fesetround(FE_UPWARD);  // spoils the tangent: corrections shrink by 60 each, however short
  StaticPathOptions options;
  options.max_points = 20;
  const StaticPath path = follow_static_path(system, options);
  std::fesetround(FE_TONEAREST);
  BOOST_REQUIRE(path.outcome.solved());
  BOOST_TEST(std::abs(tip(system, path)[1] - kElastica[2].transverse) < 2e-11);  // 10 3 N 2 eps
}

BOOST_AUTO_TEST_CASE(newton_doubles_the_digits_of_a_beam_rolled_into_a_circle_in_one_step) {
  Vector3d tip_motion;
  const NewtonResult result = roll_up(1, 40, tip_motion);
  BOOST_REQUIRE(result.outcome.solved());
  BOOST_TEST(result.correction.size() <= 5U);
  BOOST_TEST(std::abs(tip_motion[0] + 1) < 1e-10);
  BOOST_TEST(std::abs(tip_motion[1]) < 1e-10);
  BOOST_TEST(std::abs(tip_motion[2] - 2 * kPi) < 1e-10);
}

BOOST_AUTO_TEST_CASE(a_beam_rolls_up_ten_times) {
  Vector3d tip_motion;
  const NewtonResult result = roll_up(10, 200, tip_motion);
  BOOST_REQUIRE(result.outcome.solved());
  BOOST_TEST(result.correction.size() <= 8U);
  BOOST_TEST(std::abs(tip_motion[0] + 1) < 1e-9);
  BOOST_TEST(std::abs(tip_motion[1]) < 1e-9);
  BOOST_TEST(std::abs(tip_motion[2] - 20 * kPi) < 1e-8);
}

BOOST_AUTO_TEST_CASE(newton_corrections_shrink_quadratically) {
  Model model = elastica(10);
  model.loads = {{1, {-0.3, 0.8, 0.2}}};
  model.members[0].axially_flexible = true;
  const GeometricallyExactSystem system(model);
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

BOOST_AUTO_TEST_CASE(follower_loads_keep_newton_quadratic_and_meet_the_integrated_rod) {
  // In the frame of the tip a force normal to it is dead: integrate EI theta'' from the tip, s
  // backwards, by Runge-Kutta, and turn the shape so that the root is level.
  const double F = 12;
  const int steps = 4000;
  Eigen::Vector4d y = Eigen::Vector4d::Zero();  // angle, curvature, x, y along -tangent
  const auto rate = [F](const Eigen::Vector4d& z) {
    return Eigen::Vector4d(z[1], -F * std::cos(z[0]), -std::cos(z[0]), -std::sin(z[0]));
  };
  const double h = 1.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b);
    y += h / 6 * (a + 2 * b + 2 * c + rate(y + h * c));
  }
  const double turn = -y[0];  // the tip's angle over the root
  const Vector2d tip_from_root = rotated(Vector2d(-y[2], -y[3]), turn);
  Model model = elastica(30);
  LargeMotionModel large_motion;
  large_motion.follower_loads = {{1, {0, F, 0}}};
  const GeometricallyExactSystem system(model, large_motion);
  const StaticPath path = follow_static_path(system);
  BOOST_REQUIRE(path.outcome.solved());
  const Vector3d moved = tip(system, path);
  BOOST_TEST(std::abs(moved[2] - turn) < 1e-10);
  BOOST_TEST((moved.head<2>() + Vector2d(1, 0) - tip_from_root).norm() < 1e-10);
  const std::vector<double>& last = path.points.back().newton.correction;
  BOOST_TEST(last.size() <= 6U);
}

BOOST_AUTO_TEST_CASE(thin_and_thick_shear_flexible_beams_do_not_lock) {
  for (const double depth : {1e-1, 1e-3, 1e-5, 1e-6}) {
    const Section section = rectangle({1, 1, 0.3}, depth, 1);
    for (const double angle : {0.0, 0.5}) {
      Model model = cantilever(section, 1, 1, angle);
      model.members[0].theory = BeamTheory::timoshenko;
      const double load = 1e-6 * section.EI;
      model.loads = {{1, {-load * std::sin(angle), load * std::cos(angle), 0}}};
      const GeometricallyExactSystem system(model);
      Equilibrium equilibrium(system);
      State state = system.reference_state();
      BOOST_REQUIRE(equilibrium.solve(state, 1).outcome.solved());
      const Vector3d moved = node_motion(system, state.q).row(1).transpose();
      const double transverse = Vector2d(-std::sin(angle), std::cos(angle)).dot(moved.head<2>());
      const double exact = load / (3 * section.EI) + load / section.kappa_GA;
      BOOST_TEST(std::abs(transverse / exact - 1) < 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(reactions_and_section_forces_balance_the_loads_in_the_bent_shape) {
  Model model = elastica(12);
  model.members[0].axially_flexible = true;
  model.members[0].load = {0.4, -1.5};
  model.loads = {{1, {1, 2, 0.3}}};
  const GeometricallyExactSystem system(model);
  const StaticPath path = follow_static_path(system);
  BOOST_REQUIRE(path.outcome.solved());
  const State& state = path.points.back().state;
  const Eigen::RowVector3d reaction = reactions(system, state).row(0);
  BOOST_TEST(std::abs(reaction[0] + 1 + 0.4) < 1e-11);
  BOOST_TEST(std::abs(reaction[1] + 2 - 1.5) < 1e-11);
  const StaticSolution section = static_solution(system, state);
  BOOST_TEST(std::abs(section.resultant_start(0, 0) + reaction[0]) < 1e-11);
  BOOST_TEST(std::abs(section.resultant_start(0, 1) + reaction[1]) < 1e-11);
  BOOST_TEST(std::abs(section.resultant_start(0, 2) + reaction[2]) < 1e-11);
  const double angle = node_motion(system, state.q)(1, 2);
  BOOST_TEST(std::abs(section.resultant_end(0, 0) - (std::cos(angle) + 2 * std::sin(angle))) <
             1e-11);
  BOOST_TEST(std::abs(section.resultant_end(0, 1) - (2 * std::cos(angle) - std::sin(angle))) <
             1e-11);
  BOOST_TEST(std::abs(section.resultant_end(0, 2) - 0.3) < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_driven_tip_takes_the_force_that_would_move_it_there) {
  Model loaded = elastica(10);
  loaded.loads = {{1, {0, 5, 0}}};
  const GeometricallyExactSystem by_force(loaded);
  const StaticPath forced = follow_static_path(by_force);
  const double raised = tip(by_force, forced)[1];
  LargeMotionModel large_motion;
  large_motion.drives = {{"lift", 1, 1, [raised](double t) {
                            return std::array<double, 3>{t * raised, raised, 0};
                          }}};
  const GeometricallyExactSystem by_drive(elastica(10), large_motion);
  const StaticPath driven = follow_static_path(by_drive);
  BOOST_REQUIRE(driven.outcome.solved());
  BOOST_TEST(std::abs(drive_force(by_drive, driven.points.back().state, 0) - 5) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_free_motion_is_named_and_not_solved) {
  Model model = beam(unit_section(), 1, 2);
  model.supports = {pin(0)};
  model.loads = {{1, {0, 1, 0}}};
  const StaticPath path = follow_static_path(GeometricallyExactSystem(model));
  BOOST_TEST((path.outcome.status == Status::singular));
  BOOST_TEST(path.outcome.reason.find("free motion") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
