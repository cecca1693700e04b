#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "solver/linear/coordinates.h"

namespace trammel::solver {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Homogeneous linear constraint of unconstrained coordinates u: the sum of coefficient * u is
/// zero.
struct ConstraintRow {
  enum class Source { support, linear, rigid_body, inextensible };
  Source source = Source::linear;
  /// Index of the support, linear constraint, rigid body or frame element in the model or mesh.
  Index index = 0;
  std::vector<std::pair<Index, double>> terms;
};

/// Supports, linear constraints, rigid bodies and inextensible elements in the form u = T q, with
/// the unconstrained coordinates u and the free coordinates q. The constraint rows are eliminated
/// by sparse Gaussian elimination with threshold pivoting. Before the elimination, rotations are
/// multiplied by the size of the model, so that the pivots do not depend on the unit of length.
/// Redundant rows are dropped.
struct Constraints {
  /// Rows of all supports, then of linear constraints, rigid bodies and inextensible elements.
  std::vector<ConstraintRow> rows;
  std::vector<Index> pivot;  ///< row -> index in u of its eliminated coordinate; -1: dropped row
  std::vector<Index> free;   ///< index in u -> index in q, or -1 for an eliminated coordinate
  Index free_count = 0;
  RowMajorMatrix T;  ///< matrix of u = T q: one row for each u, one column for each q

  /// Returns the Lagrange multipliers lambda of the constraint rows C u = 0, with C^T lambda =
  /// `force`. The multipliers are the generalized forces [N, N m] of the constraints. The
  /// multipliers of dropped rows are 0.
  /// @param force  force on each unconstrained coordinate [N, N m].
  [[nodiscard]] Eigen::VectorXd lagrange_multipliers(const Eigen::VectorXd& force) const;
};

/// Builds the constraint rows of a model and eliminates one coordinate per independent row. The
/// result is the matrix T in u = T q.
/// @throws ModelError  if a constraint refers to a coordinate that does not exist.
[[nodiscard]] Constraints build_constraints(const Model& model,
                                            const Discretisation& discretization);

}  // namespace trammel::solver
