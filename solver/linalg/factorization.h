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

/// Returns a permutation of the rows and columns of A that reduces the fill-in of a factorization.
/// The permutation maps each index to its position in the order of elimination. Large matrices are
/// ordered by nested dissection (METIS). Small matrices are ordered by minimum degree, which takes
/// less time. For a lattice of 100,000 members, METIS reduces the time of the factorization to a
/// third.
[[nodiscard]] Permutation fill_reducing_order(const SparseMatrix& A);

/// Factorization P A P^T = L D L^T of symmetric matrices. The order P and the symbolic
/// factorization are reused while the sparsity pattern of A remains the same. In this case,
/// `factorize` and `solve` do not allocate memory.
class SparseLdlt {
 public:
  enum class Ordering { fill_reducing, natural };
  enum class Triangle { lower, upper, mean };  ///< triangle of A that is used; mean: (A + A^T) / 2

  explicit SparseLdlt(Triangle triangle = Triangle::lower,
                      Ordering ordering = Ordering::fill_reducing);

  /// Factors A. The existing factors are kept if A equals the last factored matrix.
  /// @param A  compressed matrix in which both triangles are stored.
  /// @returns false if a pivot is zero or not finite; the factors must not be used in this case.
  [[nodiscard]] bool factorize(const SparseMatrix& A);

  [[nodiscard]] const Eigen::VectorXd& pivots() const;
  /// Returns the number of negative pivots, which is the number of negative eigenvalues of A
  /// (Sylvester's law of inertia).
  [[nodiscard]] Index negative_pivots() const;
  /// Returns the smallest ratio of |pivot| to the diagonal entry of A in the same row. The ratio is
  /// near zero if A is singular.
  [[nodiscard]] double smallest_pivot_to_diagonal() const;
  /// Returns the largest magnitude of an entry of the factor L.
  [[nodiscard]] double element_growth() const;

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// Returns y = D^(-1/2) L^-1 P b, the first step to solve A x = b for a positive definite A.
  /// `apply_inverse_factor_transposed` performs the second step, x = P^T L^-T D^(-1/2) y.
  [[nodiscard]] Eigen::VectorXd apply_inverse_factor(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd apply_inverse_factor_transposed(const Eigen::VectorXd& y) const;

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

/// LDL^T factorization of a sparse symmetric matrix scaled to a unit diagonal:
///
///   S A S = P^T L D L^T P,  S = |diag A|^(-1/2).
///
/// The scaling makes meters and radians comparable. For a zero diagonal entry of A, the entry of S
/// is 1.
class Factorization {
 public:
  /// Factors A. The order of elimination is reused while the sparsity pattern of A remains the
  /// same. The pattern may change, because the mass matrix may couple coordinates that the
  /// stiffness matrix does not couple.
  void compute(const SparseMatrix& A);

  /// Returns false if a pivot of the last factorization is zero or not finite. The factors must not
  /// be used in this case.
  [[nodiscard]] bool is_nonsingular() const { return exists_; }
  /// Returns the smallest pivot of the scaled matrix S A S. This pivot is at most 1, because the
  /// scaling S gives the matrix a unit diagonal. For a positive definite A, the pivot is at least
  /// the smallest eigenvalue of S A S.
  [[nodiscard]] double smallest_pivot() const;
  /// Returns the number of negative eigenvalues of A (Sylvester's law of inertia).
  [[nodiscard]] Index negative_pivots() const { return ldlt_.negative_pivots(); }
  /// Factors A and returns the number of negative eigenvalues of A, or an empty value if this
  /// number is unreliable.
  std::optional<Index> sturm_count(const SparseMatrix& A);
  /// Returns true if the signs of the pivots are reliable. For an indefinite matrix, no row
  /// exchanges limit the entries of L. If an entry of |L| exceeds about 1e8, the pivots have no
  /// correct digits.
  [[nodiscard]] bool is_reliable() const { return exists_ && ldlt_.element_growth() < 1e8; }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Returns y = F^-1 b, the first step to solve A x = b for a positive definite A = F F^T.
  /// `apply_inverse_factor_transposed` performs the second step, x = F^-T y.
  [[nodiscard]] Eigen::VectorXd apply_inverse_factor(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::VectorXd apply_inverse_factor_transposed(const Eigen::VectorXd& y) const;

  [[nodiscard]] const Eigen::VectorXd& scaling() const { return scaling_; }

 private:
  SparseLdlt ldlt_;
  Eigen::VectorXd scaling_;
  bool exists_ = false;
};

/// LU factorization of a sparse square matrix with row exchanges. Scalar is double or
/// `std::complex<double>`. The first call of `factorize` computes the order of elimination.
/// Matrices of later calls must have the same sparsity pattern.
template <class Scalar>
class SparseLu {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  SparseLu();
  /// Factors A. Returns false if A is singular or not finite; `solve` must not be called in this
  /// case.
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<Scalar>& A);
  [[nodiscard]] Vector solve(const Vector& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

/// Symmetric operator on the free coordinates, x -> A x, more accurate than its assembled matrix.
using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Solution of a linear system by iterative refinement.
struct RefinedSolution {
  Eigen::VectorXd x;
  /// Norm of the last correction of the iterative refinement, relative to the solution x. The
  /// remaining error is about the square of this correction, divided by the previous correction. x
  /// is meaningless if `correction` is near 1 or above.
  double correction = 0;
  /// Returns false if the matrix is so ill-conditioned that the solution has no correct digits.
  [[nodiscard]] bool converged() const { return correction < 1e-4; }
};

/// Solves A x = b with a factorization of A and improves x with residuals from the operator `A`.
/// The iteration ends if round-off dominates the correction, or if a correction is more than half
/// of the previous correction. The residual is not used as criterion, because round-off errors of
/// large axial stiffness hide errors of small bending stiffness.
/// @param A  operator for the residuals.
/// @param factorization  factors of the assembled matrix of A.
/// @param b  right-hand side.
/// @param guess  initial solution; if it is accurate, a single solve is sufficient.
/// @param counters  incremented by the solves.
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                                            Counters& counters);
/// Solves A x = b by iterative refinement. The initial solution is computed with the factorization.
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, Counters& counters);

}  // namespace trammel::solver
