#pragma once

#include <Eigen/Core>

/// Functions that call the dense decompositions of the Eigen library, which are compiled only in
/// dense_eigen.cpp. All numbers of a result are NaN if an iteration does not converge, or if the
/// matrix B of A x = lambda B x is not positive definite.
namespace trammel::solver {

/// Eigenvalues and eigenvectors of a symmetric eigenvalue problem.
struct SymmetricEigenpairs {
  bool converged = false;
  Eigen::VectorXd value;   ///< eigenvalues, ascending
  Eigen::MatrixXd vector;  ///< one eigenvector per column
};

/// Solves A x = lambda x for a symmetric A, with x^T x = 1.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A);

/// Solves A x = lambda B x for a symmetric A and a symmetric positive definite B, with x^T B x = 1.
/// Only the lower triangle of A is read.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A,
                                                       const Eigen::MatrixXd& B);

/// Complex eigenvalues and eigenvectors of a general matrix.
struct ComplexEigenpairs {
  bool converged = false;
  Eigen::VectorXcd value;
  Eigen::MatrixXcd vector;  ///< one eigenvector of norm 1 per column
};

/// Solves A x = lambda x for any square A. The eigenvalues are not sorted.
[[nodiscard]] ComplexEigenpairs eigenpairs(const Eigen::MatrixXd& A);

/// Solution of three linear equations A x = b, and the ratio of the smallest to the largest pivot.
struct PivotedSolution {
  Eigen::Vector3d x;  ///< meaningless if A is singular
  /// |R_33| / |R_11| of the QR factor R; near 0 if A is singular.
  double smallest_to_largest_pivot = 0;
};
/// Solves A x = b by a QR decomposition A P = Q R with column pivoting.
[[nodiscard]] PivotedSolution pivoted_solve(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);

/// Returns the singular values of A in descending order, or NaN if A is not finite.
[[nodiscard]] Eigen::Vector3d singular_values(const Eigen::Matrix3d& A);

/// Returns the row-wise backward error of a system of equations: the largest ratio |sum_i| /
/// terms_i of all rows i. sum_i is the residual of the row, which is a sum of terms, and terms_i is
/// the sum of the magnitudes of these terms. A ratio 0 / 0 counts as 0. A ratio that is not finite
/// counts as infinite.
/// Source: Oettli and Prager (1964).
[[nodiscard]] double row_backward_error(const Eigen::VectorXd& sum, const Eigen::VectorXd& terms);

/// Lower limit of the magnitude of coordinates and forces in a backward error, relative to the
/// largest coordinate or force. The limit applies to the sum of magnitudes by which the residual of
/// a row is divided. Without the limit, this sum could consist only of round-off errors.
inline constexpr double kLeastFraction = 1e-3;

}  // namespace trammel::solver
