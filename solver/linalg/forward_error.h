#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Factored form of the stiffness, K = A^T diag(C) A with C > 0. A maps the coordinates q to
/// deformations d = A q, and C contains the rigidities of the deformations. Each entry of A is a
/// sum of terms, and `size` >= |A| contains the sum of the magnitudes of these terms. eps times
/// `size` therefore estimates the round-off error of A.
struct FactoredStiffness {
  SparseMatrix A, size;
  Eigen::VectorXd C;
};

/// Solves K q = f, K = A^T diag(C) A, without forming K. The following system is factored with row
/// exchanges:
///
///   C^-1 s = A q,  A^T s = f.
///
/// The solution of this system amplifies round-off by the condition number of A. A factorization of
/// K would amplify round-off by the square of this number.
/// Source: Bjorck (1996), Numerical Methods for Least Squares Problems, ch. 2.5 (augmented system).
class AugmentedSystem {
 public:
  explicit AugmentedSystem(FactoredStiffness factors);
  /// Returns false if the matrix of the augmented system is singular; `solve` must not be called in
  /// this case.
  [[nodiscard]] bool is_nonsingular() const { return exists_; }
  /// Returns the solution q of K q = f, improved by iterative refinement with the residuals of both
  /// equations of the system.
  [[nodiscard]] RefinedSolution solve(const Eigen::VectorXd& f) const;

 private:
  FactoredStiffness factors_;
  Eigen::VectorXd root_, scaling_;  // C^1/2, and factors that normalize the columns of C^1/2 A
  SparseLu<double> lu_;
  bool exists_ = false;
};

/// Estimates the 1-norm of an operator B from products with B and with its transpose. The estimate
/// is a lower bound, and nearly always within a factor of 3.
/// Source: Hager (1984), Higham (1988).
/// @param columns  number of columns of B.
/// @param B  x -> B x.
/// @param Bt  y -> B^T y.
[[nodiscard]] double estimate_norm(
    Eigen::Index columns, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& B,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& Bt);

/// Estimates the relative round-off error max |R dq| / max |R q| of quantities R q, where q solves
/// A^T C A q = f. dq is the effect of rounding the rows of A, the products of these rows with q,
/// and f:
///
///   dq = K^-1 (A^T C g + h),  |g| <= c size |q|,  |h| <= c (size^T |C A q| + |f|).
///
/// For a row or column with n terms and the unit round-off u,
///
///   c = (n + 1)^1/2 u.
///
/// u is eps / 2 for rounding to nearest, and eps for directed rounding. Rounding errors within a
/// sum are assumed to be independent. Errors of different sums are assumed to have the signs that
/// maximize the result. The factors A and C are perturbed instead of K. Near a singularity, the
/// estimate is therefore proportional to the condition number of A, not of K.
/// Source: Oettli & Prager (1964), Skeel (1979); Bjorck (1991), BIT 31, for least squares; LAPACK's
/// xPORFS for the maximum over the signs; Higham & Mary (2019), SIAM J. Sci. Comput., for c.
/// @param factors  factored stiffness: A, the magnitudes of its terms, and C.
/// @param R  matrix of the requested quantities R q, in comparable units.
/// @param q  solution of A^T C A q = f.
/// @param f  right-hand side.
/// @param solve  x -> K^-1 x.
[[nodiscard]] double forward_error(const FactoredStiffness& factors, const SparseMatrix& R,
                                   const Eigen::VectorXd& q, const Eigen::VectorXd& f,
                                   const Operator& solve);

}  // namespace trammel::solver
