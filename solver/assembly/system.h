#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "solver/assembly/constraints.h"
#include "solver/assembly/coordinates.h"
#include "solver/model/counters.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"

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

}  // namespace trammel::solver
