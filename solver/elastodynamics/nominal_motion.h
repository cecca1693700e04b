#pragma once

#include <Eigen/Core>
#include <array>
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
  /// A vector that turns with the part, or its derivative in time of order 1 or 2.
  [[nodiscard]] Vector2d derivative(const Vector2d& at_start, int order) const;
};

/// The nominal motion: every member, plate and rigid body of a model moves as a rigid part.
struct NominalMotion {
  /// Position, velocity and acceleration: model node x (x, y) [m], [m/s], [m/s^2].
  std::array<Eigen::MatrixX2d, 3> node;
  std::vector<PartMotion> part;         ///< members, then plates, then rigid bodies
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]
  double load_factor = 1;               ///< on the loads of the model

  /// The part of a manipulator with which the rotation of a model node turns.
  [[nodiscard]] const PartMotion& at_node(Index model_node) const {
    return model_node < 6 ? part[to_size(2 * (model_node % 3))] : part.back();
  }
};

/// Places in NominalMotion::part.
[[nodiscard]] inline Index plate_part(const Model& model, Index plate) {
  return std::ssize(model.members) + plate;
}
[[nodiscard]] inline Index body_part(const Model& model, Index body) {
  return plate_part(model, std::ssize(model.plates)) + body;
}

/// The nominal motion of every part of the built model, from that of the platform.
/// @param model  as built at joint coordinates `from` (theta_a, theta_p, x, y, phi)
[[nodiscard]] NominalMotion nominal_motion(const Model& model, const InverseDynamics& motion,
                                           const Vector9d& from, const TrajectoryPoint& point,
                                           const Vector2d& gravity);

/// Fastest turning of a part [rad/s].
[[nodiscard]] double largest_angular_velocity(const NominalMotion& motion);

}  // namespace trammel::solver
