#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <optional>

#include "solver/model/effects.h"
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

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

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

/// L U with row exchanges of a sparse square matrix, compiled once; Scalar is double or
/// std::complex<double>. The first `factorize` computes the ordering, which is kept: later matrices
/// have the same pattern.
template <class Scalar>
class SparseLu {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  SparseLu();
  /// Returns false if A is singular or not finite; then `solve` must not be called.
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<Scalar>& A);
  [[nodiscard]] Vector solve(const Vector& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

/// A symmetric operator on the free coordinates, x -> A x, more exact than its assembled matrix.
using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct RefinedSolution {
  Eigen::VectorXd x;
  double correction = 0;  ///< the last one over x: what is left of the error is about its square
                          ///< over the one before; near 1 or above, x means nothing
  /// False where the condition number has eaten all digits.
  [[nodiscard]] bool converged() const { return correction < 1e-4; }
};

/// x with A x = b where A has been factored, improved with residuals from `A`. Stops when the
/// correction is so small that its own error is rounding, or no longer halves. (The residual itself
/// would not do to tell: the rounding of stiff axial parts hides what is left in soft bending.)
/// @param guess  a good one costs a single solve.
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                                            Counters& counters);
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, Counters& counters);

}  // namespace trammel::solver
