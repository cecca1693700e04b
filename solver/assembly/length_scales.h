#pragma once

#include "solver/assembly/system.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver {

/// What makes lengths of the unconstrained coordinates u: 1 for translations, the model's size [m]
/// for rotations.
[[nodiscard]] inline Eigen::VectorXd length_scales(const System& system) {
  const double size = box_diagonal(system.mesh.positions);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(system.coordinates.size);
  for (Index u = 0; u < scale.size(); ++u) {
    if (system.coordinates.is_rotation[to_size(u)]) scale[u] = size;
  }
  return scale;
}

/// From the free coordinates q to u, all in lengths.
[[nodiscard]] inline SparseMatrix free_length_scales(const System& system) {
  return length_scales(system).asDiagonal() * system.T;
}

/// Square of the length [m] that a unit of each free coordinate moves.
[[nodiscard]] inline Eigen::VectorXd squared_lengths(const System& system) {
  const SparseMatrix lengths = free_length_scales(system);
  return lengths.cwiseAbs2().transpose() * Eigen::VectorXd::Ones(lengths.rows());
}

}  // namespace trammel::solver
