#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/linalg/refinement.h"
#include "solver/model/counters.h"
#include "solver/model/numbers.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

enum class EigenMethod { automatic, dense, sparse };

/// The pencil K x = lambda B x with K - s B positive definite; B is symmetric and may be
/// semi-definite (massless coordinates, s <= 0) or indefinite (buckling, s below the first positive
/// eigenvalue).
struct Pencil {
  const SparseMatrix* K = nullptr;
  const SparseMatrix* B = nullptr;
  double shift = 0;
  bool indefinite = false;  ///< B: there are negative eigenvalues, too
  Operator K_times;         ///< x -> K x, more exact than the assembled K
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;  ///< X -> X^T K X, the same
};

/// The lowest positive eigenvalues (above s), copies of repeated ones included.
struct Eigenpairs {
  Outcome outcome;  ///< not_converged: fewer than the inertia count says there are
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;   ///< q x pair, x^T |B| x = 1
  Eigen::VectorXd error;    ///< relative, from the residual; second order in the vector's error
  Index inertia_count = 0;  ///< eigenvalues in (s, check shift) by LDL^T, `null` included
  double check_shift = 0;
};

/// Dense or sparse: B x = mu (K - s B) x, largest mu first, mu =
/// 1 / (lambda - s). B is never factored. Every answer is improved by inverse iteration with
/// residuals of `K_times`, and counted: K - t B with t just above the last one, between clusters,
/// must have as many negative pivots as were found (Sylvester). Lanczos may miss copies of a
/// repeated value; then it goes on in the complement of what it has until the count agrees.
///
/// @param null  q x r, vectors with K x = 0 and B-orthonormal, known beforehand; they count
///              as the first eigenvalues, 0, and are not among those returned.
/// @param factorization  has `shifted(K, B, s)` factored; used up.
[[nodiscard]] Eigenpairs lowest_eigenpairs(const Pencil& pencil, const Eigen::MatrixXd& null,
                                           Index count, EigenMethod method,
                                           Factorization& factorization, Counters& counters);

/// Whether both are compressed and hold entries at the same places.
[[nodiscard]] bool same_pattern(const SparseMatrix& A, const SparseMatrix& B);

/// K - t B, with the pattern of both whatever t is.
[[nodiscard]] SparseMatrix shifted(const SparseMatrix& K, const SparseMatrix& B, double t);

}  // namespace trammel::solver
