#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// K = A^T diag(C) A, C > 0: deformations d = A q and their rigidities. `size` >= |A| has the
/// magnitudes of what A was added up from, so that eps times it is what rounding can change.
struct StiffnessFactors {
  SparseMatrix A, size;
  Eigen::VectorXd C;
};

/// K q = f from  C^-1 s = A q, A^T s = f  with row exchanges: what is lost is the condition number
/// of A, where a factorization of K loses its square.
/// Source: Bjorck (1996), Numerical Methods for Least Squares Problems, ch. 2.5 (augmented system).
class AugmentedSystem {
 public:
  explicit AugmentedSystem(StiffnessFactors factors);
  /// False where the matrix is singular; then nothing may be solved.
  [[nodiscard]] bool exists() const { return exists_; }
  /// q, refined with the residuals of both equations.
  [[nodiscard]] RefinedSolution solve(const Eigen::VectorXd& f) const;

 private:
  StiffnessFactors factors_;
  Eigen::VectorXd root_, scaling_;  // C^1/2; unit columns of C^1/2 A
  SparseLu<double> lu_;
  bool exists_ = false;
};

/// Estimate of the 1-norm of an operator from products with it and its transpose; a lower bound,
/// nearly always within a factor of 3.   Source: Hager (1984), Higham (1988).
[[nodiscard]] double estimate_norm(
    Eigen::Index columns, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& B,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& Bt);

/// Estimate of max |R dq| / max |R q| for q with A^T C A q = f, where dq is what rounding of the
/// rows of A, of their products with q and of f can do:
///   dq = K^-1 (A^T C g + h),  |g| <= c size |q|,  |h| <= c (size^T |C A q| + |f|),
/// c = (n + 1)^1/2 u with n terms in a row or column, u = eps / 2, or eps while arithmetic rounds
/// in one direction: roundings are taken as independent within a sum, and all signs at their worst
/// beyond it. Perturbing the factors of K, and not K itself, keeps what is lost beside a
/// singularity to the condition number of A. Source: Oettli & Prager (1964), Skeel (1979); Bjorck
/// (1991), BIT 31, for least squares; the maximum over the signs as in LAPACK's xPORFS; c from
/// Higham & Mary (2019), SIAM J. Sci. Comput.
/// @param R  what is wanted of q, in units that compare
/// @param solve  x -> K^-1 x
[[nodiscard]] double forward_error(const StiffnessFactors& factors, const SparseMatrix& R,
                                   const Eigen::VectorXd& q, const Eigen::VectorXd& f,
                                   const Operator& solve);

}  // namespace trammel::solver
