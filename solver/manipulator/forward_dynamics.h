#pragma once

#include <functional>
#include <vector>

#include "solver/manipulator/rigid_dynamics.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/evidence.h"

/// Forward dynamics: motion of the rigid manipulator from actuator torques.
namespace trammel::solver {

/// Acceleration of the platform.
struct PlatformAcceleration {
  Outcome outcome;        ///< as RigidTerms
  Vector3d acceleration;  ///< (xddot, yddot [m/s^2], phiddot [rad/s^2]); NaN unless solved
  double power = 0;       ///< of torques and wrench [W]; NaN unless solved
};

/// Computes the acceleration of the platform from the equation of motion of the actuator angles:
///
///   Mh theta_a.. = torque + (dx/dtheta_a)^T wrench - Ch theta_a. - Nh,
///   x.. = G theta_a.. + G. theta_a.
///
/// G consists of the last three rows of W.
[[nodiscard]] PlatformAcceleration forward_acceleration(const RigidManipulator& manipulator,
                                                        const Pose& pose, const Vector3d& velocity,
                                                        const Vector3d& torque,
                                                        const Vector3d& wrench = Vector3d::Zero());

/// Options of forward dynamics.
struct ForwardOptions {
  /// Allowed local error of a step [-]. Positions are relative to the largest position, but at
  /// least the platform radius. Velocities are relative to the largest velocity, but at least the
  /// radius over the duration of the motion.
  double tolerance = 1e-10;
  Index max_steps = 100000;  ///< limit, including rejected steps
};

/// Motion from forward dynamics.
struct ForwardDynamics {
  /// singular: as RigidTerms, or a step passes a parallel singularity at the time that the reason
  /// states. not_converged: too many steps, or the evidence does not support the motion.
  Outcome outcome;
  std::vector<TrajectoryPoint> motion;  ///< at the requested times, until the end or a failure
  Index steps = 0;
  Index rejected = 0;
  Index evaluations = 0;  ///< number of evaluations of the acceleration
  /// Residuals at the requested times: equation of motion of the actuator angles, loop closure, and
  /// energy balance. The power of torques and wrench is integrated together with the motion. Its
  /// integral is compared with the change of kinetic and potential energy.
  Evidence evidence;
};

/// Integrates pose and velocity of the platform. The loops remain closed without constraints. The
/// method is the embedded pair of Dormand and Prince (1980), order 5(4), with local extrapolation
/// (Boost.Odeint).
/// @param manipulator  rigid bodies.
/// @param start   pose and velocity at start.time [s].
/// @param torque  torques of the actuators at a time [N m].
/// @param times   ascending, not before start.time [s].
/// @param wrench  constant load on the platform at P (Fx, Fy [N], moment [N m]).
/// @param options  tolerance and limit of steps.
/// @throws ModelError  if the times do not ascend or the tolerance is not positive.
[[nodiscard]] ForwardDynamics forward_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& start,
                                               const std::function<Vector3d(double)>& torque,
                                               const std::vector<double>& times,
                                               const Vector3d& wrench = Vector3d::Zero(),
                                               const ForwardOptions& options = {});

}  // namespace trammel::solver
