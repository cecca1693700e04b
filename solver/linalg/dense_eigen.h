#pragma once

#include <Eigen/Core>

/// Eigen's dense eigenvalue solvers, compiled once. Where an iteration has not converged, or the
/// matrix of the right-hand side is not positive definite, every number of the result is NaN.
namespace trammel::solver {

template <class Matrix>
struct SymmetricEigenpairs {
  bool converged = false;
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> value;  ///< ascending
  Matrix vector;                                              ///< one a column
};

/// A x = lambda x, A Hermitian, x^H x = 1; for Matrix3d, MatrixXd and MatrixXcd.
template <class Matrix>
[[nodiscard]] SymmetricEigenpairs<Matrix> symmetric_eigenpairs(const Matrix& A);

/// A x = lambda B x, both symmetric, B positive definite, x^T B x = 1.
[[nodiscard]] SymmetricEigenpairs<Eigen::MatrixXd> symmetric_eigenpairs(const Eigen::MatrixXd& A,
                                                                        const Eigen::MatrixXd& B);

struct ComplexEigenpairs {
  bool converged = false;
  Eigen::VectorXcd value;
  Eigen::MatrixXcd vector;  ///< one a column, norm 1
};

/// A x = lambda x for any square A, in no order.
[[nodiscard]] ComplexEigenpairs eigenpairs(const Eigen::MatrixXd& A);

/// Largest |lambda| of A.
[[nodiscard]] double spectral_radius(const Eigen::MatrixXd& A);

}  // namespace trammel::solver
