#pragma once

#include <Eigen/Core>

#include "solver/linalg/refinement.h"
#include "solver/linalg/sparse_lu.h"
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

}  // namespace trammel::solver
