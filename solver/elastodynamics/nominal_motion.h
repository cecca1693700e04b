#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/inverse_dynamics.h"

/// The rigid motion of the manipulator along its path, part by part of the built model.
namespace trammel::solver {

/// Rotation of a rigid part about the position in which the model was built.
struct PartMotion {
  double angle = 0;         ///< [rad]
  double rate = 0;          ///< [rad/s]
  double acceleration = 0;  ///< [rad/s^2]

  bool operator==(const PartMotion&) const = default;
};

/// The nominal motion: every member, plate and rigid body of a model moves as a rigid part.
struct NominalMotion {
  Eigen::MatrixX2d position;      ///< model node x (x, y) [m]
  Eigen::MatrixX2d velocity;      ///< model node x (x, y) [m/s]
  Eigen::MatrixX2d acceleration;  ///< model node x (x, y) [m/s^2]
  std::vector<PartMotion> member, plate, rigid_body;
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]
  double load_factor = 1;               ///< on the loads of the model
};

/// The nominal motion of every part of the built model, from that of the platform.
/// @param from  joint coordinates where the model was built (theta_a, theta_p, x, y, phi)
[[nodiscard]] NominalMotion nominal_motion(const ManipulatorDesign& design, const Model& model,
                                           const InverseDynamics& motion, const Vector9d& from,
                                           const TrajectoryPoint& point, const Vector2d& gravity);

/// Fastest turning of a part [rad/s].
[[nodiscard]] double largest_angular_velocity(const NominalMotion& motion);

}  // namespace trammel::solver
