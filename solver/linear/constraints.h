#pragma once

#include <Eigen/SparseCore>
#include <string>
#include <utility>
#include <vector>

#include "solver/linear/coordinates.h"

namespace trammel::solver {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// One homogeneous sum over unconstrained coordinates: sum of coefficient * u = 0.
struct ConstraintRow {
  enum class Source { support, linear, rigid_body, inextensible };
  Source source = Source::linear;
  Index index = 0;  ///< support, linear constraint, rigid body, or frame element of the mesh
  std::vector<std::pair<Index, double>> terms;
};

/// Supports, linear constraints, rigid bodies and inextensible elements as u = T q: sparse
/// elimination of the constraint rows with threshold pivoting, after rotations have been multiplied
/// by the size of the model so that the choice of pivots does not depend on the unit of length. A
/// row that follows from those before it is dropped.
struct Constraints {
  std::vector<ConstraintRow> rows;  ///< all, in the order supports, linear, rigid, inextensible
  std::vector<Index> pivot;         ///< row -> coordinate it eliminates, -1 where it was dropped
  std::vector<Index> free;          ///< coordinate u -> q, or -1 where it is eliminated
  Index free_count = 0;
  RowMajorMatrix T;  ///< u x q

  /// Multipliers lambda, one a row, with C^T lambda = `force` [a force on each coordinate u]: the
  /// generalised forces by which the constraints hold the model. 0 for a dropped row.
  [[nodiscard]] Eigen::VectorXd multipliers(const Eigen::VectorXd& force) const;
};

/// @throws ModelError  where a constraint names a coordinate that does not exist.
[[nodiscard]] Constraints build_constraints(const Model& model,
                                            const Discretisation& discretisation);

}  // namespace trammel::solver
