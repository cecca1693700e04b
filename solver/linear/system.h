#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "solver/linear/constraints.h"
#include "solver/linear/coordinates.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// A linear spring between two unconstrained coordinates, or from one to the ground (-1).
struct SpringElement {
  std::array<Index, 2> coordinates{-1, -1};
  double stiffness = 0;  ///< [N/m] or [N m/rad]
};

/// The assembled linear model. The unconstrained coordinates u (node translations, node rotations,
/// rotations of released member ends) follow from the free ones q by u = T q: supports, hinges,
/// rigid bodies, Eq. 25 and inextensible members are all rows of T.
struct System {
  Model model;
  Mesh mesh;                ///< node positions and elements, for drawing
  Coordinates coordinates;  ///< numbering of u
  Constraints constraints;
  std::vector<SpringElement> springs;

  SparseMatrix T;          ///< u x q
  SparseMatrix K;          ///< stiffness, q x q [SI]; symmetric, stored whole
  SparseMatrix M;          ///< mass, q x q [SI]; symmetric, stored whole; 0 x 0 without inertia
  Eigen::VectorXd f;       ///< loads on q [SI]
  Eigen::VectorXd load;    ///< loads on u [SI]; f = T^T load
  Eigen::VectorXd weight;  ///< what of them is weight
  Counters counters;
};

/// Builds K, M, f of the free coordinates (paper Eq. 7-11) of the model without the effects that
/// are not active; without inertia there is no M.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] System assemble(const Model& model, Effects active = Effects::all());

/// Node motions of free coordinates q: model node x (ux [m], uy [m], rotation [rad]); NaN rotation
/// where a node has none.
[[nodiscard]] Eigen::MatrixX3d node_motion(const System& system, const Eigen::VectorXd& q);

/// The same of the unconstrained coordinates u.
[[nodiscard]] Eigen::MatrixX3d motion_of_nodes(const System& system, const Eigen::VectorXd& u);

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
