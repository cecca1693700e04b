#pragma once

#include "solver/manipulator/rigid_terms.h"
#include "solver/manipulator/trajectory.h"

/// Motion of all bodies, torques and powers of the rigid manipulator on its path.
namespace trammel::solver {

/// Plane motion of one body; position, velocity and acceleration of its centre of mass.
struct BodyMotion {
  Vector2d position = Vector2d::Constant(kNaN), velocity = position, acceleration = position;
  double angle = kNaN, angular_velocity = kNaN, angular_acceleration = kNaN;
};

/// NaN unless solved.
struct InverseDynamics {
  Outcome outcome;  ///< as RigidTerms
  Vector9d q = Vector9d::Constant(kNaN), q_dot = q, q_ddot = q;
  std::array<BodyMotion, 7> bodies;            ///< proximal 1-3, distal 1-3, platform
  Vector3d torque = Vector3d::Constant(kNaN);  ///< of the actuators on the proximal links [N m]
  double kinetic_energy = kNaN;                ///< [J]
  double potential_energy = kNaN;              ///< what gravity has taken up, -sum m g . x [J]
  /// Rate of the kinetic energy, body by body: sum of m v . a + J omega alpha [W]. Power balance:
  /// kinetic_power = actuator_power + load_power + gravity_power.
  double kinetic_power = kNaN;
  double actuator_power = kNaN;
  double load_power = kNaN;
  double gravity_power = kNaN;
};

/// @param wrench  load on the platform at P: (Fx, Fy [N], moment [N m]) in world axes
[[nodiscard]] InverseDynamics inverse_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& motion,
                                               const Vector3d& wrench = Vector3d::Zero());

}  // namespace trammel::solver
