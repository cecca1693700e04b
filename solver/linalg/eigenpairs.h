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

/// Symmetric pencil K x = lambda B x with a shift s for which K - s B is positive definite. In
/// vibration, B is the mass matrix. B is semidefinite if some coordinates have no mass, and then s
/// <= 0. In buckling, B may be indefinite, and s is below the first positive eigenvalue.
struct Pencil {
  const SparseMatrix* K = nullptr;
  const SparseMatrix* B = nullptr;  ///< null: `B_times` and `count_below` are used, and s = 0
  double shift = 0;                 ///< shift s, below the requested eigenvalues
  bool indefinite = false;          ///< true: B is indefinite and negative eigenvalues exist
  Operator K_times;                 ///< x -> K x, more accurate than the assembled K
  /// Function that returns X^T K X for the columns of X, more accurate than with the assembled K.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;
  Operator B_times;  ///< x -> B x, used if B is not assembled
  /// Function that returns the number of eigenvalues below a shift, or an empty value if round-off
  /// makes this number unreliable. The function is used if B is not assembled.
  std::function<std::optional<Index>(double)> count_below;
};

/// Lowest eigenvalues above the shift s with their eigenvectors. A repeated eigenvalue occurs once
/// for each independent eigenvector.
struct Eigenpairs {
  Outcome outcome;  ///< not_converged: fewer pairs than the negative pivots of K - t B require
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;  ///< one eigenvector x per column, |x^T B x| = 1
  /// Estimated relative error of each eigenvalue, which is of second order in the error of the
  /// eigenvector.
  Eigen::VectorXd error;
  /// Shift t above the computed eigenvalues and below all other eigenvalues. The number of negative
  /// pivots of K - t B confirms that no eigenvalue below t is missing.
  double check_shift = 0;
};

/// Computes the lowest eigenpairs of a pencil. The function solves B x = mu (K - s B) x for the
/// largest mu = 1 / (lambda - s), by a dense method or Lanczos' method. B is never factored. The
/// steps are:
///
/// - Every eigenpair is improved by inverse iteration with residuals computed by `K_times`.
/// - The eigenpairs are counted: K - t B must have as many negative pivots as pairs were found
///   (Sylvester's law of inertia). The shift t is just above the last pair, between two clusters of
///   eigenvalues.
/// - Lanczos' method may miss copies of a repeated eigenvalue. The method is therefore repeated in
///   the complement of the known eigenvectors until both numbers are equal.
///
/// @param pencil  matrices K and B and shift s.
/// @param null_vectors  known vectors x with K x = 0, one per column, B-orthonormal. Their
///   eigenvalue 0 is included in the counts below shifts, but the vectors are not returned.
/// @param count  number of requested pairs; if B is not assembled, all pairs below `check_shift`
///   are returned.
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

/// Returns K - t B. For any t, the sparsity pattern of the result is the union of the patterns of K
/// and B.
[[nodiscard]] SparseMatrix shifted_matrix(const SparseMatrix& K, const SparseMatrix& B, double t);

/// Returns the number of eigenvalues that are missing or superfluous among the computed
/// eigenvalues. The function compares the number of computed eigenvalues below the last clear gap
/// between adjacent eigenvalues with `count_below`. The result is infinite if no gap allows a
/// reliable count.
/// @param found  computed eigenvalues, ascending, >= 0; 0 for rigid modes.
/// @param count_below  returns the number of eigenvalues below a shift, or an empty value if the
///   number is unreliable.
[[nodiscard]] double eigenvalue_count_error(
    const Eigen::VectorXd& found, const std::function<std::optional<Index>(double)>& count_below);

/// Counts missing or superfluous eigenvalues of A x = t B x with a positive semidefinite A. The
/// number of eigenvalues below a shift t is the number of negative pivots of A - t B (Sylvester's
/// law of inertia). If A - shift_above B has as many negative pivots as eigenvalues were computed,
/// the result is 0. Otherwise, the eigenvalues below the last clear gap between adjacent
/// eigenvalues are counted.
/// @param A  positive semidefinite matrix.
/// @param B  symmetric matrix.
/// @param found  computed eigenvalues t, ascending, >= 0.
/// @param spent  factorization that the caller no longer needs. Its elimination order is reused.
///   Its factors are reused if they are those of A - shift_above B.
/// @param shift_above  shift above all computed eigenvalues, or 0 if no such shift is known.
[[nodiscard]] double eigenvalue_count_error(const SparseMatrix& A, const SparseMatrix& B,
                                            const Eigen::VectorXd& found,
                                            Factorization&& spent = {}, double shift_above = 0);

/// Returns the number of eigenvectors (columns of X) that depend linearly on other eigenvectors.
/// The test uses the products X^T metric X, which are zero for two distinct modes. Each duplicate
/// of a mode counts as one dependent eigenvector.
[[nodiscard]] Index count_dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X);

struct LanczosOptions {
  Index wanted = 1;    ///< number of requested eigenvalues, less than the operator size
  Index subspace = 2;  ///< dimension of the Krylov subspace, larger than `wanted`
  double tolerance = 1e-9;
};

/// Converged eigenpairs of Lanczos' method. There may be fewer eigenpairs than requested, or none.
struct LanczosPairs {
  Eigen::VectorXd value;   ///< eigenvalues, descending
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

/// Returns start vectors for an eigenvalue iteration: pseudo-random numbers in [-1, 1) that are the
/// same on every machine.
/// @param rows  number of rows.
/// @param columns  number of vectors.
/// @param variant  number that selects the sequence of random numbers.
[[nodiscard]] Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant = 0);

}  // namespace trammel::solver
