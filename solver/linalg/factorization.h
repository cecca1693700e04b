#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace trammel::solver {

/// Nested dissection (METIS) for large matrices, minimum degree for small ones, where the time of
/// the ordering counts; on a lattice of 100,000 members METIS cuts the factorization to a third.
struct FillReducingOrdering {
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  void operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& permutation) const;
};

/// LDL^T of a sparse symmetric matrix scaled to a unit diagonal, S A S = P^T L D L^T P with
/// S = |diag A|^(-1/2), so that metres and radians weigh alike. Where the diagonal is zero, S is 1.
class Factorization {
 public:
  /// The ordering is kept from call to call as long as the pattern of the matrix is the same: the
  /// mass may couple coordinates that the stiffness does not.
  void compute(const Eigen::SparseMatrix<double>& A);

  /// False where a pivot was exactly zero or not finite; then nothing else may be asked.
  [[nodiscard]] bool exists() const { return exists_; }
  /// Smallest pivot; S A S has unit diagonal, so that it lies below 1 and, for a positive definite
  /// matrix, is no less than its smallest eigenvalue.
  [[nodiscard]] double smallest_pivot() const;
  /// Sylvester: the number of negative eigenvalues.
  [[nodiscard]] Eigen::Index negative_pivots() const;
  /// Largest |L|: above about 1e8 an indefinite matrix without row exchanges has lost its digits.
  [[nodiscard]] double element_growth() const;
  /// Whether the signs of the pivots can be believed.
  [[nodiscard]] bool is_reliable() const { return exists_ && element_growth() < 1e8; }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// x = F^-T y, y = F^-1 b with F F^T = A, for a positive definite A.
  [[nodiscard]] Eigen::VectorXd solve_half(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd solve_half_transposed(const Eigen::VectorXd& y) const;

  [[nodiscard]] const Eigen::VectorXd& scaling() const { return scaling_; }
  /// Condition number of S A S in the 1-norm, estimated from a few solves.
  /// Source: Hager (1984), Higham (1988).
  [[nodiscard]] double condition() const;

 private:
  /// Whether the ordering at hand is that of A, which is compressed.
  [[nodiscard]] bool has_pattern_of(const Eigen::SparseMatrix<double>& A) const;

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, FillReducingOrdering> ldlt_;
  Eigen::VectorXd scaling_;
  double norm_ = 0;                  // 1-norm of S A S
  std::vector<int> columns_, rows_;  // pattern that the ordering is of
  bool exists_ = false;
};

}  // namespace trammel::solver
