#pragma once

#include <Eigen/Core>

/// Dense decompositions of Eigen, compiled once. All numbers of a result are NaN if an iteration
/// does not converge, or if B is not positive definite.
namespace trammel::solver {

/// Eigenpairs of a symmetric problem.
struct SymmetricEigenpairs {
  bool converged = false;
  Eigen::VectorXd value;   ///< ascending
  Eigen::MatrixXd vector;  ///< one eigenvector per column
};

/// Solves A x = lambda x for a symmetric A, with x^T x = 1.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A);

/// Solves A x = lambda B x for a symmetric A and a symmetric positive definite B, with x^T B x = 1.
/// Only the lower triangle of A is read.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A,
                                                       const Eigen::MatrixXd& B);

/// Eigenpairs of a general matrix.
struct ComplexEigenpairs {
  bool converged = false;
  Eigen::VectorXcd value;
  Eigen::MatrixXcd vector;  ///< one eigenvector per column, norm 1
};

/// Solves A x = lambda x for any square A. The eigenvalues have no order.
[[nodiscard]] ComplexEigenpairs eigenpairs(const Eigen::MatrixXd& A);

/// Solution of a 3 x 3 system with a measure of singularity.
struct PivotedSolution {
  Eigen::Vector3d x;                     ///< meaningless if A is singular
  double smallest_to_largest_pivot = 0;  ///< |R_33| / |R_11|; near zero if A is singular
};
/// Solves A x = b by column-pivoted QR.
[[nodiscard]] PivotedSolution pivoted_solve(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);

/// Returns the singular values in descending order, or NaN if A is not finite.
[[nodiscard]] Eigen::Vector3d singular_values(const Eigen::Matrix3d& A);

/// Returns the backward error of equations, row by row: the largest |residual| over the sum of the
/// magnitudes of its terms. 0 / 0 counts as 0. Values that are not finite count as infinite.
/// Source: Oettli and Prager (1964).
[[nodiscard]] double largest_ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& terms);

/// Least share of the largest magnitude that every coordinate or force contributes to the terms of
/// a row. It prevents rows from being judged by values that are only round-off of others.
inline constexpr double kLeastShare = 1e-3;

}  // namespace trammel::solver
