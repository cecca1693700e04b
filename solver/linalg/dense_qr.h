#pragma once

#include <Eigen/Core>

/// Eigen's dense orthogonal factorizations, compiled once.
namespace trammel::solver {

/// A = Q R by Householder reflections; Q as large as A, R square. For no more columns than rows.
struct ThinQr {
  Eigen::MatrixXd Q;
  Eigen::MatrixXd R;  ///< upper triangle; below it, anything
};
[[nodiscard]] ThinQr thin_qr(const Eigen::MatrixXd& A);

/// Orthonormal basis of the columns of A, as many as its numerical rank; by column pivoting.
[[nodiscard]] Eigen::MatrixXd range_basis(const Eigen::MatrixXd& A);

struct PivotedSolution {
  Eigen::Vector3d x;
  double smallest_to_largest_pivot =
      0;  ///< |R_33| / |R_11|: near zero where A is singular, and x is nothing
};
/// A x = b by column-pivoted QR.
[[nodiscard]] PivotedSolution pivoted_solve(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);

/// Of A = U S V^T; NaN where A is not finite.
struct RightSingularVectors {
  bool converged = false;
  Eigen::VectorXd value;   ///< descending
  Eigen::MatrixXd vector;  ///< columns of V
};
[[nodiscard]] RightSingularVectors right_singular_vectors(const Eigen::MatrixXd& A);

/// Descending; NaN where A is not finite.
[[nodiscard]] Eigen::Vector3d singular_values(const Eigen::Matrix3d& A);

}  // namespace trammel::solver
