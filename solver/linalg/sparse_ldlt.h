#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "solver/model/counters.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// Old place -> place in an order of elimination with little fill-in: nested dissection (METIS) for
/// large matrices, minimum degree for small ones, where the time of the ordering counts; on a
/// lattice of 100,000 members METIS cuts the factorization to a third.
[[nodiscard]] Permutation fill_reducing_order(const SparseMatrix& A);

/// P A P^T = L D L^T of symmetric matrices. The order P and the symbolic work are kept as long as
/// the pattern stays the same; then neither `factorize` nor `solve` allocates.
class SparseLdlt {
 public:
  enum class Ordering { fill_reducing, natural };
  enum class Triangle { lower, upper, mean };  ///< which one is read; mean: (A + A^T) / 2

  explicit SparseLdlt(Triangle triangle = Triangle::lower,
                      Ordering ordering = Ordering::fill_reducing);

  /// Keeps the factors if the matrix is the last one. Returns false if a pivot was zero or not
  /// finite; then no other function may be called.
  /// @param A  compressed, with the pattern of both triangles
  [[nodiscard]] bool factorize(const SparseMatrix& A);

  [[nodiscard]] const Eigen::VectorXd& pivots() const;
  /// Sylvester: the number of negative eigenvalues.
  [[nodiscard]] Index negative_pivots() const;
  /// Smallest |pivot| over its diagonal entry: near zero where A is singular.
  [[nodiscard]] double smallest_to_largest_pivot() const;
  /// Largest |L|.
  [[nodiscard]] double element_growth() const;

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// y = D^(-1/2) L^-1 P b and x = P^T L^-T D^(-1/2) y, for a positive definite A.
  [[nodiscard]] Eigen::VectorXd solve_half(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd solve_half_transposed(const Eigen::VectorXd& y) const;
  /// R = D^(1/2) L^T P, so that R^T R = A; pivots below zero count as zero.
  [[nodiscard]] SparseMatrix square_root() const;

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

}  // namespace trammel::solver
