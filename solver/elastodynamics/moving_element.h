#pragma once

#include <array>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/elastodynamics/nominal_motion.h"
#include "solver/elements/frame_element.h"

namespace trammel::solver {

/// An element that turns with a rigid part; its matrices in world axes where the model was built.
struct MovingElement {
  enum class Layout { frame, triangle, point_mass, scalar };  ///< what the coordinates are

  Layout layout = Layout::frame;
  std::array<Index, 6> coordinates{-1, -1, -1, -1, -1, -1};
  Matrix6d k = Matrix6d::Zero(), m = Matrix6d::Zero();
  Matrix6d first_derivative = Matrix6d::Zero();                  ///< int rho N^T dN/dangle
  Matrix6d second_derivative = Matrix6d::Zero();                 ///< int rho N^T d2N/dangle2
  const std::vector<PartMotion> NominalMotion::*part = nullptr;  ///< null: does not turn
  std::size_t part_index = 0;
  Vector2d first_moment = Vector2d::Zero();  ///< of a point mass: mass * offset [kg m]

  [[nodiscard]] PartMotion motion(const NominalMotion& nominal) const {
    return part ? (nominal.*part)[part_index] : PartMotion{};
  }
  /// Coordinates from a node's x to the next node's.
  [[nodiscard]] Index stride() const { return layout == Layout::triangle ? 2 : 3; }
  /// Q A Q^T with Q the rotation of the coordinates by `angle` [rad].
  [[nodiscard]] Matrix6d rotated(const Matrix6d& A, double angle) const;
};

/// Frame elements in the order of the mesh, then triangles, point masses, rotary inertias of the
/// members' ends, springs.
/// @throws ModelError  for triangles of six nodes.
[[nodiscard]] std::vector<MovingElement> moving_elements(const System& system);

}  // namespace trammel::solver
