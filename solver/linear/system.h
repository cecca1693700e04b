#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "solver/linear/constraints.h"
#include "solver/linear/coordinates.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Linear spring between two unconstrained coordinates, or between the ground (-1) and a
/// coordinate.
struct SpringElement {
  std::array<Index, 2> coordinates{-1, -1};
  /// Spring stiffness [N/m] or [N m/rad].
  double stiffness = 0;
};

/// Assembled linear model. The unconstrained coordinates u are node translations, node rotations,
/// and rotations of released member ends. They follow from the free coordinates q by u = T q. The
/// matrix T satisfies the constraints: supports, hinges, rigid bodies, linear constraints
/// (LinearConstraint) and inextensible members.
struct System {
  Model model;
  Mesh mesh;                ///< node positions and elements, also used for drawings
  Coordinates coordinates;  ///< numbering of the unconstrained coordinates u
  Constraints constraints;
  std::vector<SpringElement> springs;

  /// Matrix T in u = T q: one row per unconstrained coordinate, one column per free coordinate.
  SparseMatrix T;
  /// Stiffness matrix of the free coordinates q [SI]; symmetric, both triangles stored.
  SparseMatrix K;
  /// Mass matrix of the free coordinates q [SI]; symmetric, both triangles stored; 0 x 0 without
  /// inertia.
  SparseMatrix M;
  Eigen::VectorXd f;       ///< loads on the free coordinates q [SI]; f = T^T load
  Eigen::VectorXd load;    ///< loads on the unconstrained coordinates u [SI]
  Eigen::VectorXd weight;  ///< part of `load` that is weight [SI]
  Counters counters;
};

/// Builds K, M and f of the free coordinates (Varalakshmi & Srinivas 2017, Eq. 7-11). Effects that
/// are not active are removed from the model first. M is empty if inertia is not active.
/// @throws ModelError  if the model is invalid.
[[nodiscard]] System assemble(const Model& model, Effects active = Effects::all());

/// Converts free coordinates q to displacements of the model nodes: one row (ux [m], uy [m],
/// rotation [rad]) per node. The rotation is NaN for a node without rotation.
[[nodiscard]] Eigen::MatrixX3d node_motion(const System& system, const Eigen::VectorXd& q);

/// Converts unconstrained coordinates u to displacements of the model nodes: one row (ux [m], uy
/// [m], rotation [rad]) per node. The rotation is NaN for a node without rotation.
[[nodiscard]] Eigen::MatrixX3d node_motion_from_unconstrained(const System& system,
                                                              const Eigen::VectorXd& u);

/// Returns factors that convert the unconstrained coordinates u to lengths: 1 for translations, the
/// model size [m] for rotations.
[[nodiscard]] inline Eigen::VectorXd length_scales(const System& system) {
  const double size = box_diagonal(system.mesh.positions);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(system.coordinates.size);
  for (Index u = 0; u < scale.size(); ++u) {
    if (system.coordinates.is_rotation[to_size(u)]) scale[u] = size;
  }
  return scale;
}

/// Returns the matrix that maps the free coordinates q to the unconstrained coordinates u in units
/// of length (rotations times the model size).
[[nodiscard]] inline SparseMatrix free_to_length_matrix(const System& system) {
  return length_scales(system).asDiagonal() * system.T;
}

/// Returns one value [m^2] per free coordinate: the sum of squares of all coordinates u for a unit
/// value of the free coordinate. Rotations are multiplied by the model size.
[[nodiscard]] inline Eigen::VectorXd summed_squared_lengths(const System& system) {
  const SparseMatrix lengths = free_to_length_matrix(system);
  return lengths.cwiseAbs2().transpose() * Eigen::VectorXd::Ones(lengths.rows());
}

}  // namespace trammel::solver
