#include "solver/large/large_elastodynamics.h"

#include <boost/test/unit_test.hpp>
#include <string>

#include "solver/large/equilibrium.h"
#include "tests/support/solver/equal_statics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(large_elastodynamics)

using namespace trammel::solver;

namespace {

ElastodynamicsOptions options_of(ElbowKind elbow, double angular_speed, double end, double step) {
  ElastodynamicsOptions options;
  options.design = meshed_design(2);
  options.design.elbow.fill({elbow, elbow == ElbowKind::sprung ? 5.0 : 0.0});
  options.path =
      Circle{.center = {0.25, 0.144}, .radius = 0.01, .angular_speed = angular_speed, .phi = 0};
  options.time.end = end;
  options.time.step = step;
  for (int i = 0; i <= 8; ++i) options.time.sample_times.push_back(i * end / 8);
  return options;
}

constexpr std::array kElbows = {ElbowKind::welded, ElbowKind::hinged, ElbowKind::sprung};

double largest(const Eigen::MatrixX2d& rows) {
  return rows.rowwise().norm().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(large_motion_without_inertia_is_large_statics) {
  for (const ElbowKind elbow : kElbows) {
    ElastodynamicsOptions options = options_of(elbow, 1e-4, 6e4, 1);  // inertia forces * 1e-8
    options.wrench = {10, 0, 0};
    options.gravity = {0, -1};
    options.elastic_inertia = false;
    const ElastodynamicsSolution motion = solve_large_elastodynamics(options);
    BOOST_TEST_REQUIRE(motion.outcome.solved(), motion.outcome.reason);
    BOOST_TEST(motion.time.size() == 9U);
    for (std::size_t i = 0; i < motion.time.size(); ++i) {
      const Model model = static_model(options, motion.nominal[i]);
      check_equal_statics(motion.state[i], solve_large_statics(model), 1e-8, 1e-8);
    }
  }
}

/// Small loads displace P by a few micrometers and rotate the platform by less than 1e-4 rad. The
/// relative differences between linear and geometrically exact theory are of this order.
BOOST_AUTO_TEST_CASE(small_motions_are_those_of_linear_theory) {
  for (const ElbowKind elbow : kElbows)
    for (const bool quasi_static : {true, false}) {
      ElastodynamicsOptions options = options_of(elbow, 1, 0.4, 1e-3);
      options.wrench = {1e-3, 2e-3, 0};
      options.gyroscopic = true;
      options.time.scheme = generalized_alpha(0.8);
      options.time.quasi_static_start = quasi_static;
      const ElastodynamicsSolution linear = solve_elastodynamics(options);
      const ElastodynamicsSolution large = solve_large_elastodynamics(options);
      BOOST_TEST_REQUIRE(linear.outcome.solved(), linear.outcome.reason);
      BOOST_TEST_REQUIRE(large.outcome.solved(), large.outcome.reason);
      const double size = largest(linear.deflection);
      BOOST_TEST(largest(large.deflection - linear.deflection) < 2e-3 * size);
      BOOST_TEST((large.torque - linear.torque).norm() < 5e-3 * linear.torque.norm());
      BOOST_TEST((large.platform_rotation - linear.platform_rotation).norm() <
                 1e-2 * linear.platform_rotation.norm());
      BOOST_TEST((large.rigid_torque - linear.rigid_torque).norm() <=
                 1e-12 * linear.rigid_torque.norm());
    }
}

BOOST_AUTO_TEST_CASE(inertia_of_nominal_motion_loads_quasi_static_motion) {
  for (const ElbowKind elbow : kElbows) {
    ElastodynamicsOptions options = options_of(elbow, 1, 6, 1);
    options.design.platform.mass = 2;
    options.elastic_inertia = false;
    const ElastodynamicsSolution linear = solve_elastodynamics(options);
    const ElastodynamicsSolution large = solve_large_elastodynamics(options);
    BOOST_TEST_REQUIRE(large.outcome.solved(), large.outcome.reason);
    const double size = largest(linear.deflection);
    BOOST_TEST(largest(large.deflection - linear.deflection) < 5e-3 * size);
    BOOST_TEST(largest(large.deflection - linear.deflection) > 0);
  }
}

/// The platform moves on a fast circle under a load of 10 N. The damped motion starts
/// quasi-statically, so that it nearly equals the motion without elastic inertia. Linear theory
/// differs from it by 8 %.
BOOST_AUTO_TEST_CASE(damping_does_not_act_on_the_nominal_motion) {
  ElastodynamicsOptions options = options_of(ElbowKind::hinged, 1, 6, 5e-3);
  options.wrench = {10, 0, 0};
  options.damping = {.mass = 5, .stiffness = 3e-3};
  options.time.scheme = generalized_alpha(0.8);
  options.time.quasi_static_start = true;
  const ElastodynamicsSolution moving = solve_large_elastodynamics(options);
  BOOST_TEST_REQUIRE(moving.outcome.solved(), moving.outcome.reason);
  options.elastic_inertia = false;
  const ElastodynamicsSolution still = solve_large_elastodynamics(options);
  const double size = largest(still.deflection);
  BOOST_TEST(largest(moving.deflection - still.deflection) < 3e-3 * size);
  BOOST_TEST(largest(solve_elastodynamics(options).deflection - still.deflection) > 0.03 * size);
}

/// A quasi-static start with damping differs from the equilibrium without damping, and has
/// different velocities. The difference of the strain rates once caused spurious damping forces at
/// the start.
BOOST_AUTO_TEST_CASE(strongly_damped_start_agrees_with_linear_theory) {
  ElastodynamicsOptions options = options_of(ElbowKind::hinged, 5, 0.2, 2e-3);
  options.wrench = {1e-3, 5e-4, 0};
  options.gyroscopic = true;
  options.damping = {.mass = 0.02, .stiffness = 0.2};
  options.time.quasi_static_start = true;
  const StaticSolution linear = solve_elastodynamics(options).state.front();
  const ElastodynamicsSolution large = solve_large_elastodynamics(options);
  BOOST_TEST_REQUIRE(large.outcome.solved(), large.outcome.reason);
  BOOST_TEST((large.state.front().resultant_end - linear.resultant_end).norm() <
             5e-3 * linear.resultant_end.norm());
  options.wrench = {10, 0, 0};  // once failed: Newton's method omitted the damping
  BOOST_TEST(solve_large_elastodynamics(options).outcome.solved());
}

/// Time steps end at the breakpoints of the load history. The time integration once missed a pulse
/// that lasts a fifth of a step.
BOOST_AUTO_TEST_CASE(pulse_within_a_step_is_resolved) {
  ElastodynamicsOptions options = options_of(ElbowKind::welded, 0.01, 0.04, 5e-3);
  options.wrench = {1, 0, 0};
  options.load_history = {{0.011, 0.0115, 0.012}, {0, 1, 0}};
  options.gyroscopic = true;
  const double linear = largest(solve_elastodynamics(options).deflection);
  const ElastodynamicsSolution large = solve_large_elastodynamics(options);
  BOOST_TEST_REQUIRE(large.outcome.solved(), large.outcome.reason);
  BOOST_TEST(large.time.size() == 9U);
  BOOST_TEST(largest(large.deflection) == linear, boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(path_out_of_reach_is_reported) {
  // Time steps of 5e-3 s resolve the vibration. With time steps of 1e-2 s, round-off decides if the
  // motion fails before the path leaves the workspace.
  ElastodynamicsOptions options = options_of(ElbowKind::hinged, 1, 1, 5e-3);
  options.path = Line{{0.25, 0.144, 0}, {0.25, 0.9, 0}, 1};
  options.time.sample_times = {0, 1};
  const Outcome found = solve_large_elastodynamics(options).outcome;
  BOOST_TEST(found.reason.find("cannot reach") != std::string::npos, found.reason);
}

BOOST_AUTO_TEST_CASE(unsupported_options_are_refused) {
  const ElastodynamicsOptions good = options_of(ElbowKind::hinged, 1, 1, 1e-2);
  const auto refuses = [&](const auto& change) {
    ElastodynamicsOptions options = good;
    change(options);
    BOOST_CHECK_THROW((void)solve_large_elastodynamics(options), ModelError);
  };
  refuses([](auto& o) { o.design.active[1].kind = ActiveKind::free; });
  refuses([](auto& o) {
    for (auto& joint : o.design.platform_joint) joint.kind = PlatformJointKind::eq25_mean;
  });
  refuses([](auto& o) { o.time.adaptive = ErrorControl{}; });
  refuses([](auto& o) { o.modal_superposition = true; });
  refuses([](auto& o) { o.nominal_inertia = false; });
  refuses([](auto& o) { o.load_history = {{0, 0.5, 0.5, 1}, {0, 0, 1, 1}}; });
  refuses([](auto& o) { o.time.scheme = newmark(0, 0.5); });
  refuses([](auto& o) {
    o.design.platform.kind = PlatformKind::triangles;
    o.design.platform.six_nodes = true;
  });
  refuses([](auto& o) { o.elastic_inertia = false, o.time.sample_times.clear(); });
}

BOOST_AUTO_TEST_SUITE_END()
