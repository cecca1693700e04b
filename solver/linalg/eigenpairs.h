#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/linalg/factorization.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

enum class EigenMethod { automatic, dense, sparse };

/// The pencil K x = lambda B x with K - s B positive definite; B is symmetric and may be
/// semi-definite (massless coordinates, s <= 0) or indefinite (buckling, s below the first positive
/// eigenvalue).
struct Pencil {
  const SparseMatrix* K = nullptr;
  const SparseMatrix* B = nullptr;  ///< null: `B_times` and `count_below`, with s = 0
  double shift = 0;
  bool indefinite = false;  ///< B: there are negative eigenvalues, too
  Operator K_times;         ///< x -> K x, more exact than the assembled K
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;  ///< X -> X^T K X, the same
  Operator B_times;  ///< x -> B x of a B that is not assembled
  /// Number of eigenvalues below a shift; nothing if round-off dominates it.
  std::function<std::optional<Index>(double)> count_below;
};

/// The lowest positive eigenvalues (above s), copies of repeated ones included.
struct Eigenpairs {
  Outcome outcome;  ///< not_converged: fewer than the inertia count
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;  ///< q x pair, x^T |B| x = 1
  Eigen::VectorXd error;   ///< relative, from the residual; second order in the vector's error
  double check_shift = 0;  ///< above them and below all others, by the inertia of LDL^T
};

/// Solves B x = mu (K - s B) x for the largest mu = 1 / (lambda - s), dense or by Lanczos' method.
/// B is never factored. Every pair is improved by inverse iteration with residuals of `K_times`,
/// and counted: K - t B with t just above the last one, between clusters, must have as many
/// negative pivots as pairs were found (Sylvester). Lanczos' method may miss copies of a repeated
/// value; it then continues in the complement of the known vectors until the count agrees.
///
/// @param null  q x r, known vectors with K x = 0, B-orthonormal; they count as the first
///              eigenvalues, 0, and are not returned.
/// @param count  number of pairs; of a B that is not assembled all below `check_shift` are returned
/// @param factorization  of `shifted(K, B, s)`; overwritten.
[[nodiscard]] Eigenpairs lowest_eigenpairs(const Pencil& pencil, const Eigen::MatrixXd& null,
                                           Index count, EigenMethod method,
                                           Factorization& factorization, Counters& counters);

/// True if both are compressed and hold entries at the same places.
[[nodiscard]] bool same_pattern(const SparseMatrix& A, const SparseMatrix& B);

/// K - t B, with the pattern of both for any t.
[[nodiscard]] SparseMatrix shifted(const SparseMatrix& K, const SparseMatrix& B, double t);

/// Number of eigenvalues that are missing or too many among those found, judged at the last clear
/// gap among them; infinite if no gap can be counted.
/// @param found  ascending, >= 0; 0 of free motions
/// @param count_below  as of `Pencil`
[[nodiscard]] double miscounted_eigenvalues(
    const Eigen::VectorXd& found, const std::function<std::optional<Index>(double)>& count_below);

/// The same of A x = t B x, A positive semidefinite, by the negative pivots of A - t B (Sylvester):
/// at the given shift above all found, if the two agree there, otherwise at the last clear gap.
/// @param spent  a factorization that is no longer needed, reused for its ordering and, if it is of
///               A - shift_above B, for its factors
[[nodiscard]] double miscounted_eigenvalues(const SparseMatrix& A, const SparseMatrix& B,
                                            const Eigen::VectorXd& found,
                                            Factorization&& spent = {}, double shift_above = 0);

/// Number of eigenvectors that depend on the others, by their products in a metric in which they
/// are orthogonal: a mode that was found twice counts once.
[[nodiscard]] Index dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X);

struct LanczosOptions {
  Index wanted = 1;    ///< eigenvalues, below the operator's size
  Index subspace = 2;  ///< vectors kept between restarts, above `wanted`
  double tolerance = 1e-9;
};

/// Those that converged; there may be fewer than were wanted, or none.
struct LanczosPairs {
  Eigen::VectorXd value;   ///< descending
  Eigen::MatrixXd vector;  ///< one a column
};

/// Largest eigenvalues of a symmetric operator, by Lanczos' method with implicit restarts
/// (Spectra).
[[nodiscard]] LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options);

/// Columns for an eigenvalue iteration to start from: numbers in [-1, 1), the same everywhere.
/// @param variant  another sequence
[[nodiscard]] Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant = 0);

}  // namespace trammel::solver
