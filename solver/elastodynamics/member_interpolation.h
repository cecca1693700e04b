#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/assembly/system.h"

namespace trammel::solver {

/// What is known at the nodes of a model, at the nodes of its mesh: linear between the ends of a
/// member, as every affine field is.
class MemberInterpolation {
 public:
  explicit MemberInterpolation(const System& system);
  /// @param values  model node x (x, y)
  [[nodiscard]] Vector2d at(Index mesh_node, const Eigen::MatrixX2d& values) const;

 private:
  std::vector<std::array<Index, 2>> span_;  // mesh node -> ends of its member ...
  std::vector<double> fraction_;            // ... and where it lies between them
};

}  // namespace trammel::solver
