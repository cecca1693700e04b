#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "solver/linear/coordinates.h"

namespace trammel::solver {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Linear constraint between unconstrained coordinates u: the sum of coefficient * u is zero.
struct ConstraintRow {
  enum class Source { support, linear, rigid_body, inextensible };
  Source source = Source::linear;
  Index index = 0;  ///< index of the support, constraint, rigid body or frame element
  std::vector<std::pair<Index, double>> terms;
};

/// Supports, linear constraints, rigid bodies and inextensible elements in the form u = T q, with
/// the unconstrained coordinates u and the free coordinates q. The constraint rows are eliminated
/// by sparse Gaussian elimination with threshold pivoting. Rotations are multiplied by the size of
/// the model first, so that the pivots do not depend on the unit of length. Redundant rows are
/// dropped.
struct Constraints {
  /// Rows of all supports, then of linear constraints, rigid bodies and inextensible elements.
  std::vector<ConstraintRow> rows;
  std::vector<Index> pivot;  ///< row -> coordinate that it eliminates, or -1 for a dropped row
  std::vector<Index> free;   ///< index in u -> index in q, or -1 for an eliminated coordinate
  Index free_count = 0;
  RowMajorMatrix T;  ///< matrix of u = T q: one row for each u, one column for each q

  /// Returns the Lagrange multipliers lambda of the constraint rows C u = 0, with C^T lambda =
  /// `force`. They are the generalized forces [N, N m] of the constraints. They are 0 for dropped
  /// rows.
  /// @param force  force on each unconstrained coordinate [N, N m].
  [[nodiscard]] Eigen::VectorXd lagrange_multipliers(const Eigen::VectorXd& force) const;
};

/// Builds the constraint rows of a model and eliminates them, which results in the matrix T of u =
/// T q.
/// @throws ModelError  if a constraint refers to a coordinate that does not exist.
[[nodiscard]] Constraints build_constraints(const Model& model,
                                            const Discretisation& discretization);

}  // namespace trammel::solver
