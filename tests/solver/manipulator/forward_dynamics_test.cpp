// ctest: labels=manipulator;dynamics
#include "solver/manipulator/forward_dynamics.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(forward_dynamics)

namespace {

using namespace trammel;
using namespace trammel::solver;
using boost::test_tools::tolerance;

std::vector<double> time_grid(double end, int count) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k <= count; ++k) times.push_back(end * k / count);
  return times;
}

double point_distance(const Pose& a, const Pose& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

BOOST_AUTO_TEST_CASE(inverse_dynamics_torques_reproduce_the_circle) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const Path circle = Circle{{0.25, 0.144}, 0.01, 1};
  const auto torque = [&](double t) { return inverse_dynamics(m, at(circle, t)).torque; };
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    const ForwardDynamics f = solver::forward_dynamics(m, at(circle, 0), torque, time_grid(6.3, 63),
                                                       Vector3d::Zero(), {.tolerance = tolerance});
    BOOST_TEST_REQUIRE(f.outcome.solved(), f.outcome.reason);
    double worst = 0;
    for (const TrajectoryPoint& p : f.motion)
      worst = std::max(worst, point_distance(p.pose, at(circle, p.time).pose));
    BOOST_TEST_MESSAGE("tolerance " << tolerance << ": error " << worst << " m, " << f.steps
                                    << " steps, " << f.rejected << " rejected");
    BOOST_TEST(worst < 100 * tolerance);
  }
}

BOOST_AUTO_TEST_CASE(motion_without_torque_keeps_its_energy) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const auto none = [](double) { return Vector3d(Vector3d::Zero()); };
  TrajectoryPoint start{0, centered_pose()};
  ForwardDynamics f = solver::forward_dynamics(m, start, none, time_grid(1, 4));
  BOOST_TEST_REQUIRE(f.outcome.solved());
  BOOST_TEST(point_distance(f.motion.back().pose, start.pose) == 0.0);

  start.velocity = {0.1, 0.05, 0.2};
  f = solver::forward_dynamics(m, start, none, time_grid(0.5, 10));
  BOOST_TEST_REQUIRE(f.outcome.solved(), f.outcome.reason);
  const double energy = inverse_dynamics(m, start).kinetic_energy;
  for (const TrajectoryPoint& p : f.motion)
    BOOST_TEST(inverse_dynamics(m, p).kinetic_energy == energy, tolerance(1e-8));
  BOOST_TEST(point_distance(f.motion.back().pose, start.pose) > 0.01);
}

BOOST_AUTO_TEST_CASE(energy_residual_does_not_depend_on_the_samples) {
  const auto residual = [](int count) {
    RigidManipulator m = rigid_manipulator(table_1_design());
    const auto torque = [&m](double t) {
      if (t > 0.05) m.gravity = {0, -0.1};  // gravity starts: the potential energy jumps
      return Vector3d(0.1, 0.1, 0.1);
    };
    return solver::forward_dynamics(m, {0, centered_pose()}, torque, time_grid(0.1, count))
        .evidence.largest(Residual::energy);
  };
  BOOST_TEST(residual(2) > 1e-3);
  BOOST_TEST(residual(40) == residual(2), tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(torque_function_with_a_delay_is_refused) {
  RigidManipulator m = rigid_manipulator(table_1_design());
  m.gravity = {0, -9.81};
  const Path circle = Circle{{0.25, 0.144}, 0.01, 1};
  for (const double late : {0.0, 1e-3}) {
    double last = kNaN;  // time of the last call
    const auto torque = [&](double t) {
      const bool first = t != last;
      last = t;
      return inverse_dynamics(m, at(circle, first ? t - late : t)).torque;
    };
    const ForwardDynamics f = solver::forward_dynamics(m, at(circle, 0), torque, time_grid(1, 10));
    BOOST_TEST(f.outcome.solved() == (late == 0), f.outcome.reason);
    if (late == 0) BOOST_TEST(f.evidence.largest(Residual::energy) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(step_over_a_parallel_singularity_ends_the_motion) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const Circle circle{.center = {0.25, 0.144}, .radius = 0.01, .angular_speed = 1, .phi = 0};
  // The load makes the pose unstable, so that the manipulator collapses within a second.
  const Vector3d load(10, 0, 0);
  const auto torque = [&](double t) { return inverse_dynamics(m, at(circle, t), load).torque; };
  const ForwardDynamics f =
      solver::forward_dynamics(m, at(circle, 0), torque, time_grid(2, 20), load);
  BOOST_TEST((f.outcome.status == Status::singular));
  BOOST_TEST(f.outcome.reason.find("a parallel (type 2) singularity") != std::string::npos,
             f.outcome.reason);
  BOOST_TEST(f.motion.size() == 12U);
}

BOOST_AUTO_TEST_CASE(times_that_do_not_ascend_are_refused) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const auto none = [](double) { return Vector3d(Vector3d::Zero()); };
  const TrajectoryPoint start{0, centered_pose()};
  BOOST_CHECK_THROW((void)solver::forward_dynamics(m, start, none, {0, 1, 0.5}), ModelError);
  BOOST_CHECK_THROW((void)solver::forward_dynamics(m, start, none, {std::nan("")}), ModelError);
  BOOST_CHECK_THROW(
      (void)solver::forward_dynamics(m, start, none, {1}, Vector3d::Zero(), {.tolerance = 0}),
      ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
