#pragma once

#include <Eigen/Core>
#include <optional>

#include "solver/linalg/sparse_ldlt.h"
#include "solver/model/counters.h"

namespace trammel::solver {

/// LDL^T of a sparse symmetric matrix scaled to a unit diagonal, S A S = P^T L D L^T P with
/// S = |diag A|^(-1/2), so that metres and radians weigh alike. Where the diagonal is zero, S is 1.
class Factorization {
 public:
  /// The ordering is kept from call to call as long as the pattern of the matrix is the same: the
  /// mass may couple coordinates that the stiffness does not.
  void compute(const SparseMatrix& A);

  /// False where a pivot was exactly zero or not finite; then nothing else may be asked.
  [[nodiscard]] bool exists() const { return exists_; }
  /// Smallest pivot; S A S has unit diagonal, so that it lies below 1 and, for a positive definite
  /// matrix, is no less than its smallest eigenvalue.
  [[nodiscard]] double smallest_pivot() const;
  /// Sylvester: the number of negative eigenvalues.
  [[nodiscard]] Index negative_pivots() const { return ldlt_.negative_pivots(); }
  /// Factors A and returns the number of its negative eigenvalues, or nothing if it is not
  /// reliable.
  std::optional<Index> inertia(const SparseMatrix& A);
  /// Whether the signs of the pivots can be believed: where |L| exceeds about 1e8, an indefinite
  /// matrix without row exchanges has lost its digits.
  [[nodiscard]] bool is_reliable() const { return exists_ && ldlt_.element_growth() < 1e8; }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// x = F^-T y, y = F^-1 b with F F^T = A, for a positive definite A.
  [[nodiscard]] Eigen::VectorXd solve_half(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd solve_half_transposed(const Eigen::VectorXd& y) const;

  [[nodiscard]] const Eigen::VectorXd& scaling() const { return scaling_; }

 private:
  SparseLdlt ldlt_;
  Eigen::VectorXd scaling_;
  bool exists_ = false;
};

}  // namespace trammel::solver
