#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/elements/frame_element.h"
#include "solver/linear/system.h"
#include "solver/manipulator/link_superelement.h"
#include "solver/manipulator/rigid_dynamics.h"

/// Nominal rigid motion of each member, plate and rigid body of a manipulator along its path.
namespace trammel::solver {

/// Rotation of a member, plate or rigid body relative to the pose at which the model was built.
struct PartMotion {
  /// Rotation angle [rad].
  double angle = 0;
  /// Angular velocity [rad/s].
  double rate = 0;
  /// Angular acceleration [rad/s^2].
  double acceleration = 0;

  bool operator==(const PartMotion&) const = default;
  /// Returns a vector that rotates with the member, plate or rigid body (order 0), or its first or
  /// second time derivative (order 1, 2). At the pose at which the model was built, the vector is
  /// `at_start`.
  [[nodiscard]] Vector2d rotated_derivative(const Vector2d& at_start, int order) const;
};

/// Nominal motion of a manipulator: every member, plate and rigid body of the model moves rigidly.
struct NominalMotion {
  /// Positions [m], velocities [m/s] and accelerations [m/s^2] of the model nodes, one row (x, y)
  /// per node.
  std::array<Eigen::MatrixX2d, 3> node;
  std::vector<PartMotion> part;         ///< rotations of members, then plates, then rigid bodies
  Vector2d gravity = Vector2d::Zero();  ///< acceleration of gravity [m/s^2]
  double load_factor = 1;               ///< factor on the loads of the model

  /// Returns the motion of the link or platform with which a model node rotates: the proximal link
  /// for A_i and B_i, and the platform for all other nodes.
  [[nodiscard]] const PartMotion& part_motion_at_node(Index model_node) const {
    return model_node < 6 ? part[to_size(2 * (model_node % 3))] : part.back();
  }
};

/// Returns the index of a plate in the list NominalMotion::part.
[[nodiscard]] inline Index plate_part_index(const Model& model, Index plate) {
  return std::ssize(model.members) + plate;
}
/// Returns the index of a rigid body in the list NominalMotion::part.
[[nodiscard]] inline Index body_part_index(const Model& model, Index body) {
  return plate_part_index(model, std::ssize(model.plates)) + body;
}

/// Computes the nominal motion of every member, plate and rigid body from the motion of the
/// platform.
/// @param model  model that was built at the joint coordinates `from`.
/// @param motion  inverse dynamics for the platform motion `point`.
/// @param from  joint coordinates (theta_a, theta_p, x, y, phi) [rad, m].
/// @param point  motion of the platform.
/// @param gravity  acceleration of gravity [m/s^2].
[[nodiscard]] NominalMotion nominal_motion(const Model& model, const InverseDynamics& motion,
                                           const Vector9d& from, const TrajectoryPoint& point,
                                           const Vector2d& gravity);

/// Returns the largest angular velocity of all members, plates and rigid bodies [rad/s].
[[nodiscard]] double largest_angular_velocity(const NominalMotion& motion);

/// Rotates the vectors (x, y) in the columns i and i + 1 by the angle with cosine c and sine s.
template <class Block>
void rotate_adjacent_columns(Block& v, Index i, double c, double s) {
  const auto x = (c * v.col(i) - s * v.col(i + 1)).eval();
  v.col(i + 1) = s * v.col(i) + c * v.col(i + 1);
  v.col(i) = x;
}

/// Element that rotates with a member, plate or rigid body. The element matrices are constant in
/// element axes.
struct MovingElement {
  /// Arrangement of the coordinates in element matrices.
  enum class Layout { frame, triangle, point_mass, scalar };

  Layout layout = Layout::frame;
  std::array<Index, 6> coordinates{-1, -1, -1, -1, -1, -1};
  FrameDeformation B = FrameDeformation::Zero();  ///< maps element coordinates to deformations
  Vector3d c = Vector3d::Zero();                  ///< rigidities of the three deformations
  Matrix6d k = Matrix6d::Zero();                  ///< stiffness, B^T diag(c) B
  Matrix6d m = Matrix6d::Zero();
  /// Integral of rho W^T dW/dangle in element axes. W is the interpolation in world axes.
  Matrix6d first_derivative = Matrix6d::Zero();
  /// Integral of rho W^T d2W/dangle2 in element axes. W is the interpolation in world axes.
  Matrix6d second_derivative = Matrix6d::Zero();
  /// Direction of the element x axis at the pose at which the model was built, world axes.
  Vector2d axis = Vector2d::UnitX();
  Index part = -1;                           ///< index in NominalMotion::part; -1: no rotation
  Vector2d first_moment = Vector2d::Zero();  ///< mass * offset of a point mass [kg m]

  [[nodiscard]] PartMotion part_motion(const NominalMotion& nominal) const {
    return part < 0 ? PartMotion{} : nominal.part[to_size(part)];
  }
  /// Returns the direction of the element x axis at the pose of `nominal`, world axes.
  [[nodiscard]] Vector2d axis_direction(const NominalMotion& nominal) const;
  /// Returns the number of coordinates per node.
  [[nodiscard]] Index coordinates_per_node() const { return layout == Layout::triangle ? 2 : 3; }

  /// Rotates a block with 6 columns, one per coordinate, from element axes to world axes.
  template <class Block>
  void to_world(Block& v, const Vector2d& direction) const {
    if (layout == Layout::scalar) return;
    for (Index i = 0; i + 1 < 6; i += coordinates_per_node())
      rotate_adjacent_columns(v, i, direction.x(), direction.y());
  }
  /// Rotates a block with 6 columns, one per coordinate, from world axes to element axes.
  template <class Block>
  void to_element_axes(Block& v, const Vector2d& direction) const {
    to_world(v, Vector2d(direction.x(), -direction.y()));
  }
  /// Transforms an element matrix A from element axes to world axes.
  [[nodiscard]] Matrix6d matrix_in_world_axes(const Matrix6d& A, const Vector2d& direction) const;
};

/// Returns the moving elements of a model: frame elements in the order of the mesh, then triangles,
/// point masses, rotary inertias of member ends, and springs. If `links` is not empty, the mass
/// matrices of the condensed members `links` replace the mass matrices of the frame elements.
/// @throws ModelError  if the model contains six-node triangles.
[[nodiscard]] std::vector<MovingElement> moving_elements(
    const System& system, const std::vector<LinkSuperelement>& links);

}  // namespace trammel::solver
