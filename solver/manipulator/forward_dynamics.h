#pragma once

#include <functional>
#include <vector>

#include "solver/manipulator/rigid_dynamics.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/evidence.h"

/// Forward dynamics: motion of the rigid manipulator from actuator torques.
namespace trammel::solver {

/// Acceleration of the platform of the rigid manipulator under actuator torques.
struct PlatformAcceleration {
  Outcome outcome;        ///< singular: the pose is out of reach or singular
  Vector3d acceleration;  ///< (xddot, yddot [m/s^2], phiddot [rad/s^2]); NaN unless solved
  double power = 0;       ///< power of actuator torques and wrench [W]; NaN unless solved
};

/// Computes the acceleration of the platform from the equation of motion of the actuator angles:
///
///   Mh theta_a.. = torque + (dx/dtheta_a)^T wrench - Ch theta_a. - Nh,
///   x.. = G theta_a.. + G. theta_a.
///
/// Mh, Ch, Nh and W are those of RigidTerms. G = dx/dtheta_a consists of the last three rows of W.
[[nodiscard]] PlatformAcceleration forward_acceleration(const RigidManipulator& manipulator,
                                                        const Pose& pose, const Vector3d& velocity,
                                                        const Vector3d& torque,
                                                        const Vector3d& wrench = Vector3d::Zero());

/// Options of forward dynamics.
struct ForwardOptions {
  /// Allowed local error of a time step [-]. Errors of the pose are relative to the largest pose
  /// coordinate, or to the platform radius if the radius is larger. Errors of velocities are
  /// relative to the largest velocity, or to the platform radius over the duration of the motion if
  /// this ratio is larger.
  double tolerance = 1e-10;
  Index max_steps = 100000;  ///< limit of the number of time steps, including rejected ones
};

/// Motion of the rigid manipulator under actuator torques.
struct ForwardDynamics {
  /// singular: a pose is out of reach or singular, or a step passes a parallel singularity. The
  /// reason states the time. not_converged: the number of steps or a residual exceeds its limit.
  Outcome outcome;
  /// Motion at the requested times, up to the last requested time or a failure.
  std::vector<TrajectoryPoint> motion;
  Index steps = 0;
  Index rejected = 0;
  /// Number of evaluations of the platform acceleration.
  Index evaluations = 0;
  /// Residuals of three equations at the requested times: equation of motion of the actuator
  /// angles, loop closure, and energy balance. The power of torques and wrench is integrated
  /// together with the motion. The integral of the power is compared with the change of kinetic and
  /// potential energy.
  Evidence evidence;
};

/// Integrates pose and velocity of the platform over time. The joint angles follow from the pose,
/// so that the loops are closed without constraint equations. The method is the embedded
/// Runge-Kutta pair of Dormand and Prince (1980), order 5(4), with local extrapolation
/// (Boost.Odeint).
/// @param manipulator  rigid bodies of the manipulator.
/// @param start   pose and velocity at start.time [s].
/// @param torque  function that returns the actuator torques at a time [N m].
/// @param times  ascending times at which the motion is returned, not before start.time [s].
/// @param wrench  constant load on the platform at P (Fx, Fy [N], moment [N m]).
/// @param options  error tolerance and limit of the number of time steps.
/// @throws ModelError  if the times do not ascend or the tolerance is not positive.
[[nodiscard]] ForwardDynamics forward_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& start,
                                               const std::function<Vector3d(double)>& torque,
                                               const std::vector<double>& times,
                                               const Vector3d& wrench = Vector3d::Zero(),
                                               const ForwardOptions& options = {});

}  // namespace trammel::solver
