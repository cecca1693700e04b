#pragma once

#include <Eigen/Core>

/// Eigen's dense decompositions, compiled once. If an iteration does not converge, or the matrix of
/// the right-hand side is not positive definite, every number of the result is NaN.
namespace trammel::solver {

struct SymmetricEigenpairs {
  bool converged = false;
  Eigen::VectorXd value;   ///< ascending
  Eigen::MatrixXd vector;  ///< one per column
};

/// A x = lambda x, A symmetric, x^T x = 1.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A);

/// A x = lambda B x, both symmetric, B positive definite, x^T B x = 1. Of A the lower triangle is
/// read.
[[nodiscard]] SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A,
                                                       const Eigen::MatrixXd& B);

struct ComplexEigenpairs {
  bool converged = false;
  Eigen::VectorXcd value;
  Eigen::MatrixXcd vector;  ///< one per column, norm 1
};

/// A x = lambda x for any square A, in no order.
[[nodiscard]] ComplexEigenpairs eigenpairs(const Eigen::MatrixXd& A);

struct PivotedSolution {
  Eigen::Vector3d x;                     ///< meaningless if A is singular
  double smallest_to_largest_pivot = 0;  ///< |R_33| / |R_11|, near zero if A is singular
};
/// Solves A x = b by column-pivoted QR.
[[nodiscard]] PivotedSolution pivoted_solve(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);

/// Singular values, descending; NaN if A is not finite.
[[nodiscard]] Eigen::Vector3d singular_values(const Eigen::Matrix3d& A);

/// Backward error of equations, row by row: the largest |residual| over the sum of the magnitudes
/// of its terms; 0 / 0 counts as 0, what is not a number as infinite.
/// Source: Oettli and Prager (1964).
[[nodiscard]] double largest_ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& terms);

/// No row is judged by coordinates or forces that are rounding of the others: each counts with at
/// least this share of the largest.
inline constexpr double kLeastShare = 1e-3;

}  // namespace trammel::solver
