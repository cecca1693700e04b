#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/linalg/factorization.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Method of an eigenvalue solver; `automatic` selects by the size of the problem.
enum class EigenMethod { automatic, dense, sparse };

/// Pencil K x = lambda B x with symmetric B and a shift s for which K - s B is positive definite. B
/// is semidefinite if some coordinates have no mass; then s <= 0. In buckling, B may be indefinite,
/// and s is below the first positive eigenvalue.
struct Pencil {
  const SparseMatrix* K = nullptr;
  const SparseMatrix* B = nullptr;  ///< null: use `B_times` and `count_below`, with s = 0
  double shift = 0;                 ///< shift s, below the requested eigenvalues
  bool indefinite = false;          ///< true: B is indefinite and negative eigenvalues exist
  Operator K_times;                 ///< x -> K x, more accurate than the assembled K
  /// Function that returns X^T K X for the columns of X, more accurate than with the assembled K.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;
  Operator B_times;  ///< x -> B x for a B that is not assembled
  /// Function that returns the number of eigenvalues below a shift, or an empty value if round-off
  /// dominates this number.
  std::function<std::optional<Index>(double)> count_below;
};

/// Lowest eigenvalues above the shift s with their eigenvectors. A repeated eigenvalue has one
/// entry for each independent eigenvector.
struct Eigenpairs {
  Outcome outcome;  ///< not_converged: fewer pairs than the negative pivots of K - t B require
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;  ///< q x pair, x^T |B| x = 1
  /// Estimated relative error of each eigenvalue; it is of second order in the error of the
  /// eigenvector.
  Eigen::VectorXd error;
  /// Value t above the computed eigenvalues and below all other eigenvalues. The number of negative
  /// pivots of K - t B confirms this.
  double check_shift = 0;
};

/// Computes the lowest eigenpairs of a pencil. It solves B x = mu (K - s B) x for the largest mu =
/// 1 / (lambda - s), by a dense method or Lanczos' method. B is never factored. The steps are:
///
/// - Every pair is improved by inverse iteration with residuals of `K_times`.
/// - The pairs are counted: K - t B must have as many negative pivots as pairs were found
///   (Sylvester). The shift t is just above the last pair, between clusters.
/// - Lanczos' method may miss copies of a repeated value. It continues in the complement of the
///   known eigenvectors until the count agrees.
///
/// @param pencil  matrices K and B and shift s.
/// @param null_vectors  q x r, known vectors with K x = 0, B-orthonormal. They count as the first
///   eigenvalues, 0, and are not returned.
/// @param count  number of pairs; if B is not assembled, all pairs below `check_shift` are
///   returned.
/// @param method  dense, sparse or automatic.
/// @param factorization  factors of `shifted_matrix(K, B, s)`; overwritten.
/// @param counters  incremented by the factorizations and solves.
/// @returns the pairs; `outcome` is not_converged if the matrix is too ill-conditioned or pairs are
///   missing.
[[nodiscard]] Eigenpairs lowest_eigenpairs(const Pencil& pencil,
                                           const Eigen::MatrixXd& null_vectors, Index count,
                                           EigenMethod method, Factorization& factorization,
                                           Counters& counters);

/// Returns true if both matrices are compressed and have entries at the same positions.
[[nodiscard]] bool same_pattern(const SparseMatrix& A, const SparseMatrix& B);

/// Returns K - t B. Its pattern combines those of K and B for any t.
[[nodiscard]] SparseMatrix shifted_matrix(const SparseMatrix& K, const SparseMatrix& B, double t);

/// Returns the number of eigenvalues that are missing or superfluous among those found. It compares
/// the counts of found and existing eigenvalues below the last clear gap between eigenvalues. The
/// result is infinite if no gap allows a reliable count.
/// @param found  found eigenvalues, ascending, >= 0; 0 for rigid modes.
/// @param count_below  returns the number of eigenvalues below a shift, as in `Pencil`.
[[nodiscard]] double eigenvalue_count_error(
    const Eigen::VectorXd& found, const std::function<std::optional<Index>(double)>& count_below);

/// Counts missing or superfluous eigenvalues of A x = t B x with a positive semidefinite A. It uses
/// the negative pivots of A - t B (Sylvester). If A - shift_above B has as many negative pivots as
/// values were found, the result is 0. Otherwise the count below the last clear gap between
/// eigenvalues is used.
/// @param A  positive semidefinite matrix.
/// @param B  symmetric matrix.
/// @param found  found eigenvalues t, ascending, >= 0.
/// @param spent  factorization that is no longer needed. Its ordering is reused. Its factors are
///   reused if they belong to A - shift_above B.
/// @param shift_above  shift above all found values, or 0.
[[nodiscard]] double eigenvalue_count_error(const SparseMatrix& A, const SparseMatrix& B,
                                            const Eigen::VectorXd& found,
                                            Factorization&& spent = {}, double shift_above = 0);

/// Returns the number of eigenvectors that depend linearly on the others. The test uses their
/// products in a metric in which distinct modes are orthogonal. A duplicate mode counts once.
[[nodiscard]] Index count_dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X);

struct LanczosOptions {
  Index wanted = 1;    ///< number of eigenvalues, below the size of the operator
  Index subspace = 2;  ///< number of vectors kept between restarts, above `wanted`
  double tolerance = 1e-9;
};

/// Converged eigenpairs of Lanczos' method. There may be fewer than requested, or none.
struct LanczosPairs {
  Eigen::VectorXd value;   ///< descending
  Eigen::MatrixXd vector;  ///< one eigenvector per column
};

/// Computes the largest eigenvalues of a symmetric operator by Lanczos' method with implicit
/// restarts (Spectra).
/// @param apply  x -> A x.
/// @param start  start vector.
/// @param options  number of eigenvalues, size of the subspace, tolerance.
[[nodiscard]] LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options);

/// Returns start vectors for an eigenvalue iteration: numbers in [-1, 1) that are the same on every
/// machine.
/// @param rows  number of rows.
/// @param columns  number of vectors.
/// @param variant  selects a different sequence of numbers.
[[nodiscard]] Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant = 0);

}  // namespace trammel::solver
