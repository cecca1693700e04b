#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/model.h"

namespace trammel {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// What was evaluated; the same on every machine, and zero for what a scene does not call for.
struct Counters {
  std::int64_t element_evaluations = 0;
  std::int64_t factorizations = 0;
  std::int64_t solves = 0;
};

/// The assembled linear model. The unconstrained coordinates u (node translations, node rotations,
/// rotations of released member ends) follow from the free ones q by u = T q: supports, hinges,
/// rigid bodies, Eq. 25 and inextensible members are all rows of T.
struct System {
  Model model;        ///< with every member cut into its elements' nodes (see `mesh`)
  SparseMatrix T;     ///< u x q
  SparseMatrix K;     ///< stiffness, q x q [SI]; symmetric, stored whole
  SparseMatrix M;     ///< mass, q x q [SI]; symmetric, stored whole
  Eigen::VectorXd f;  ///< loads on q [SI]
  Counters counters;

  // helpers by the implementer: coordinate numbering, element list ...
};

/// Builds K, M, f of the free coordinates (paper Eq. 7-11).
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] System assemble(const Model& model);

}  // namespace trammel
