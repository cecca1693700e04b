#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/elements/frame_element.h"
#include "solver/linear/system.h"
#include "solver/manipulator/link_superelement.h"
#include "solver/manipulator/rigid_dynamics.h"

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
/// @param model  as built at joint coordinates `from` (theta_a, theta_p, x, y, phi).
[[nodiscard]] NominalMotion nominal_motion(const Model& model, const InverseDynamics& motion,
                                           const Vector9d& from, const TrajectoryPoint& point,
                                           const Vector2d& gravity);

/// Fastest turning of a part [rad/s].
[[nodiscard]] double largest_angular_velocity(const NominalMotion& motion);

/// Turns the pair (x, y) of columns that begins at column i by the angle of (c, s).
template <class Block>
void turn_columns(Block& v, Index i, double c, double s) {
  const auto x = (c * v.col(i) - s * v.col(i + 1)).eval();
  v.col(i + 1) = s * v.col(i) + c * v.col(i + 1);
  v.col(i) = x;
}

/// An element that turns with a rigid part. Its matrices are constant in its own axes.
struct MovingElement {
  enum class Layout { frame, triangle, point_mass, scalar };  ///< of the coordinates

  Layout layout = Layout::frame;
  std::array<Index, 6> coordinates{-1, -1, -1, -1, -1, -1};
  FrameDeformation B = FrameDeformation::Zero();  ///< its own axes -> deformations
  Vector3d c = Vector3d::Zero();                  ///< rigidities of the three deformations
  Matrix6d k = Matrix6d::Zero();                  ///< B^T diag(c) B
  Matrix6d m = Matrix6d::Zero();
  Matrix6d first_derivative = Matrix6d::Zero();   ///< int rho N^T dN/dangle
  Matrix6d second_derivative = Matrix6d::Zero();  ///< int rho N^T d2N/dangle2
  Vector2d axis = Vector2d::UnitX();  ///< its own x axis where the model was built, world axes
  Index part = -1;                    ///< of NominalMotion; -1: does not turn
  Vector2d first_moment = Vector2d::Zero();  ///< of a point mass: mass * offset [kg m]

  [[nodiscard]] PartMotion motion(const NominalMotion& nominal) const {
    return part < 0 ? PartMotion{} : nominal.part[to_size(part)];
  }
  /// Its own x axis during a motion, world axes.
  [[nodiscard]] Vector2d direction(const NominalMotion& nominal) const;
  /// Coordinates from a node's x to the next node's.
  [[nodiscard]] Index stride() const { return layout == Layout::triangle ? 2 : 3; }

  /// Turns the columns of a block (any x 6), one column a coordinate, from its own axes to world
  /// axes.
  template <class Block>
  void to_world(Block& v, const Vector2d& direction) const {
    if (layout == Layout::scalar) return;
    for (Index i = 0; i + 1 < 6; i += stride()) turn_columns(v, i, direction.x(), direction.y());
  }
  /// The same from world axes to its own.
  template <class Block>
  void to_own(Block& v, const Vector2d& direction) const {
    to_world(v, Vector2d(direction.x(), -direction.y()));
  }
  /// The matrix A of its own axes in world axes.
  [[nodiscard]] Matrix6d in_world(const Matrix6d& A, const Vector2d& direction) const;
};

/// Frame elements in the order of the mesh, then triangles, point masses, rotary inertias of the
/// members' ends, springs.
/// @param links  condensed members, in place of the frame elements; empty: none is condensed.
/// @throws ModelError  for triangles of six nodes.
[[nodiscard]] std::vector<MovingElement> moving_elements(
    const System& system, const std::vector<LinkSuperelement>& links);

}  // namespace trammel::solver
