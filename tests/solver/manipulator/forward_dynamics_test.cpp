// ctest: labels=manipulator;dynamics
#include "solver/manipulator/forward_dynamics.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(forward_dynamics)

namespace {

using namespace trammel::solver;

std::vector<double> times_to(double end, int count) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k <= count; ++k) times.push_back(end * k / count);
  return times;
}

double distance(const Pose& a, const Pose& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_acceleration_that_needs_a_torque_is_the_one_that_the_torque_gives) {
  RigidManipulator m = rigid_manipulator(table_1_design());
  m.gravity = {0, -9.81};
  const Vector3d wrench(10, 0, 0.3);
  TrajectoryPoint p{0, {0.26, 0.15, 0.1}, {0.3, -0.2, 1}, {2, 1, -3}};
  const InverseDynamics d = inverse_dynamics(m, p, wrench);
  const PlatformAcceleration a = forward_acceleration(m, p.pose, p.velocity, d.torque, wrench);
  BOOST_TEST_REQUIRE(a.outcome.solved());
  BOOST_TEST((a.acceleration - p.acceleration).norm() < 1e-12 * p.acceleration.norm());
}

BOOST_AUTO_TEST_CASE(the_torques_of_the_circle_bring_the_platform_around_the_circle) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const Path circle = Circle{{0.25, 0.144}, 0.01, 1};
  const auto torque = [&](double t) { return inverse_dynamics(m, at(circle, t)).torque; };
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    const ForwardDynamics f = trammel::solver::forward_dynamics(
        m, at(circle, 0), torque, times_to(6.3, 63), Vector3d::Zero(), {.tolerance = tolerance});
    BOOST_TEST_REQUIRE(f.outcome.solved(), f.outcome.reason);
    double worst = 0;
    for (const TrajectoryPoint& p : f.motion)
      worst = std::max(worst, distance(p.pose, at(circle, p.time).pose));
    BOOST_TEST_MESSAGE("tolerance " << tolerance << ": error " << worst << " m, " << f.steps
                                    << " steps, " << f.rejected << " rejected");
    BOOST_TEST(worst < 100 * tolerance);
  }
}

BOOST_AUTO_TEST_CASE(without_torque_the_energy_stays_and_a_platform_at_rest_rests) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const auto none = [](double) { return Vector3d(Vector3d::Zero()); };
  TrajectoryPoint start{0, centred_pose()};
  ForwardDynamics f = trammel::solver::forward_dynamics(m, start, none, times_to(1, 4));
  BOOST_TEST_REQUIRE(f.outcome.solved());
  BOOST_TEST(distance(f.motion.back().pose, start.pose) == 0.0);

  start.velocity = {0.1, 0.05, 0.2};
  f = trammel::solver::forward_dynamics(m, start, none, times_to(0.5, 10));
  BOOST_TEST_REQUIRE(f.outcome.solved(), f.outcome.reason);
  const double energy = inverse_dynamics(m, start).kinetic_energy;
  for (const TrajectoryPoint& p : f.motion)
    BOOST_TEST(std::abs(inverse_dynamics(m, p).kinetic_energy / energy - 1) < 1e-8);
  BOOST_TEST(distance(f.motion.back().pose, start.pose) > 0.01);
}

BOOST_AUTO_TEST_CASE(energy_from_nowhere_counts_the_same_however_many_times_are_asked_for) {
  const auto residual = [](int count) {
    RigidManipulator m = rigid_manipulator(table_1_design());
    const auto torque = [&m](double t) {
      if (t > 0.05) m.gravity = {0, -0.1};  // lifts the whole in no time
      return Vector3d(0.1, 0.1, 0.1);
    };
    return trammel::solver::forward_dynamics(m, {0, centred_pose()}, torque, times_to(0.1, count))
        .evidence.largest(Residual::energy);
  };
  BOOST_TEST(residual(2) > 1e-3);
  BOOST_TEST(residual(40) == residual(2), boost::test_tools::tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(torques_that_the_integration_saw_too_late_are_not_solved) {
  RigidManipulator m = rigid_manipulator(table_1_design());
  m.gravity = {0, -9.81};
  const Path circle = Circle{{0.25, 0.144}, 0.01, 1};
  for (const double late : {0.0, 1e-3}) {
    double last = kNaN;  // the integration asks for a time before its evidence does
    const auto torque = [&](double t) {
      const bool first = t != last;
      last = t;
      return inverse_dynamics(m, at(circle, first ? t - late : t)).torque;
    };
    const ForwardDynamics f =
        trammel::solver::forward_dynamics(m, at(circle, 0), torque, times_to(1, 10));
    BOOST_TEST(f.outcome.solved() == (late == 0), f.outcome.reason);
    if (late == 0) BOOST_TEST(f.evidence.largest(Residual::energy) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_step_over_a_parallel_singularity_ends_the_motion) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const Circle circle{.center = {0.25, 0.144}, .radius = 0.01, .angular_speed = 1, .phi = 0};
  const Vector3d load(10, 0, 0);  // under which the posture is unstable: it falls over in a second
  const auto torque = [&](double t) { return inverse_dynamics(m, at(circle, t), load).torque; };
  const ForwardDynamics f =
      trammel::solver::forward_dynamics(m, at(circle, 0), torque, times_to(2, 20), load);
  BOOST_TEST((f.outcome.status == Status::singular));
  BOOST_TEST(f.outcome.reason.find("a parallel (type 2) singularity") != std::string::npos,
             f.outcome.reason);
  BOOST_TEST(f.motion.size() == 12U);
}

BOOST_AUTO_TEST_CASE(a_fall_into_a_singular_posture_ends_with_its_time_and_reason) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  TrajectoryPoint start{0, centred_pose()};
  start.velocity = {1, 0, 0};
  const auto none = [](double) { return Vector3d(Vector3d::Zero()); };
  const ForwardDynamics f = trammel::solver::forward_dynamics(m, start, none, times_to(100, 1000));
  BOOST_TEST(!f.outcome.solved());
  BOOST_TEST(f.outcome.reason.find("at ") == 0U, f.outcome.reason);
  BOOST_TEST(f.motion.size() < 1001U);
  for (const TrajectoryPoint& p : f.motion) BOOST_TEST(p.velocity.allFinite());
}

BOOST_AUTO_TEST_CASE(times_that_do_not_ascend_are_refused) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const auto none = [](double) { return Vector3d(Vector3d::Zero()); };
  const TrajectoryPoint start{0, centred_pose()};
  BOOST_CHECK_THROW((void)trammel::solver::forward_dynamics(m, start, none, {0, 1, 0.5}),
                    ModelError);
  BOOST_CHECK_THROW((void)trammel::solver::forward_dynamics(m, start, none, {std::nan("")}),
                    ModelError);
  BOOST_CHECK_THROW((void)trammel::solver::forward_dynamics(m, start, none, {1}, Vector3d::Zero(),
                                                            {.tolerance = 0}),
                    ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
