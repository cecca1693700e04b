#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "solver/linear/coordinates.h"

namespace trammel::solver {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Homogeneous constraint on unconstrained coordinates: sum of coefficient * u = 0.
struct ConstraintRow {
  enum class Source { support, linear, rigid_body, inextensible };
  Source source = Source::linear;
  Index index = 0;  ///< support, linear constraint, rigid body, or frame element of the mesh
  std::vector<std::pair<Index, double>> terms;
};

/// Supports, linear constraints, rigid bodies and inextensible elements in the form u = T q. The
/// constraint rows are eliminated by sparse Gaussian elimination with threshold pivoting. Rotations
/// are multiplied by the size of the model first, so that the pivots do not depend on the unit of
/// length. Redundant rows are dropped.
struct Constraints {
  /// All rows, in the order supports, linear, rigid, inextensible.
  std::vector<ConstraintRow> rows;
  std::vector<Index> pivot;  ///< row -> eliminated coordinate, or -1 for a dropped row
  std::vector<Index> free;   ///< coordinate u -> q, or -1 for an eliminated coordinate
  Index free_count = 0;
  RowMajorMatrix T;  ///< u x q

  /// Returns the multipliers lambda, one for each row, with C^T lambda = `force`. They are the
  /// generalized forces [N, N m] of the constraints. Dropped rows have 0.
  /// @param force  force on each unconstrained coordinate [N, N m].
  [[nodiscard]] Eigen::VectorXd multipliers(const Eigen::VectorXd& force) const;
};

/// Builds the constraint rows and T.
/// @throws ModelError  if a constraint refers to a coordinate that does not exist.
[[nodiscard]] Constraints build_constraints(const Model& model,
                                            const Discretisation& discretization);

}  // namespace trammel::solver
