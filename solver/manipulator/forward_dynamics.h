#pragma once

#include <functional>
#include <vector>

#include "solver/manipulator/rigid_dynamics.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/evidence.h"

/// From actuator torques back to the motion of the rigid manipulator.
namespace trammel::solver {

struct PlatformAcceleration {
  Outcome outcome;        ///< as RigidTerms
  Vector3d acceleration;  ///< (xddot, yddot [m/s^2], phiddot [rad/s^2]); NaN unless solved
  double power = 0;       ///< of torque and wrench [W]; NaN unless solved
};

/// Mh theta_a.. = torque + (dx/dtheta_a)^T wrench - Ch theta_a. - Nh, taken to the platform by
/// x.. = G theta_a.. + G. theta_a. with G the last three rows of W.
[[nodiscard]] PlatformAcceleration forward_acceleration(const RigidManipulator& manipulator,
                                                        const Pose& pose, const Vector3d& velocity,
                                                        const Vector3d& torque,
                                                        const Vector3d& wrench = Vector3d::Zero());

struct ForwardOptions {
  double tolerance = 1e-10;  ///< local error a step, relative to the largest position or velocity,
                             ///< and to no less than the platform's radius, or that over the
                             ///< duration of the motion
  Index max_steps = 100000;  ///< taken and rejected
};

struct ForwardDynamics {
  /// singular: as RigidTerms, or where a step passes a parallel singularity, at the time that the
  /// reason names; not_converged: too many steps, or the evidence does not bear out the motion
  Outcome outcome;
  std::vector<TrajectoryPoint> motion;  ///< at the times asked for, as far as reached
  Index steps = 0;
  Index rejected = 0;
  Index evaluations = 0;  ///< of the acceleration
  /// Equation of motion of the actuators' coordinates, and closing of the loops, at the times asked
  /// for; kinetic and potential energy against the work of torques and wrench, whose power is
  /// integrated beside the motion.
  Evidence evidence;
};

/// Integrates pose and velocity of the platform, so that the loops stay closed by themselves, with
/// the embedded pair of Dormand and Prince (1980), order 5(4), local extrapolation (Boost.Odeint).
/// @param start   pose and velocity at start.time [s].
/// @param torque  of the actuators at a time [N m].
/// @param times   ascending, from start.time on [s].
/// @throws ModelError  where the times do not ascend or the tolerance is not positive.
[[nodiscard]] ForwardDynamics forward_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& start,
                                               const std::function<Vector3d(double)>& torque,
                                               const std::vector<double>& times,
                                               const Vector3d& wrench = Vector3d::Zero(),
                                               const ForwardOptions& options = {});

}  // namespace trammel::solver
