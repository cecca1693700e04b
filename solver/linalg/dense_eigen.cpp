#include "solver/linalg/dense_eigen.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::solver {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

SymmetricEigenpairs symmetric_eigenpairs(const MatrixXd& A) {
  if (A.size() == 0) return {true, {}, {}};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  if (solver.info() == Eigen::Success) return {true, solver.eigenvalues(), solver.eigenvectors()};
  const Index n = A.rows();
  return {false, VectorXd::Constant(n, kNaN), MatrixXd::Constant(n, n, kNaN)};
}

SymmetricEigenpairs symmetric_eigenpairs(const MatrixXd& A, const MatrixXd& B) {
  const Eigen::LLT<MatrixXd> cholesky(B);
  const Index n = A.rows();
  if (cholesky.info() != Eigen::Success)
    return {false, VectorXd::Constant(n, kNaN), MatrixXd::Constant(n, n, kNaN)};
  MatrixXd C = A.selfadjointView<Eigen::Lower>();
  cholesky.matrixL().solveInPlace<Eigen::OnTheLeft>(C);
  cholesky.matrixU().solveInPlace<Eigen::OnTheRight>(C);
  SymmetricEigenpairs pairs = symmetric_eigenpairs(C);
  cholesky.matrixU().solveInPlace(pairs.vector);
  return pairs;
}

ComplexEigenpairs eigenpairs(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  if (solver.info() == Eigen::Success) return {true, solver.eigenvalues(), solver.eigenvectors()};
  const Index n = A.rows();
  return {false, Eigen::VectorXcd::Constant(n, kNaN), Eigen::MatrixXcd::Constant(n, n, kNaN)};
}

PivotedSolution pivoted_solve(const Matrix3d& A, const Vector3d& b) {
  const Eigen::ColPivHouseholderQR<Matrix3d> qr(A);
  return {qr.solve(b), std::abs(qr.matrixR()(2, 2)) / std::abs(qr.matrixR()(0, 0))};
}

Vector3d singular_values(const Matrix3d& A) {
  const Eigen::JacobiSVD<Matrix3d> svd(A);
  return svd.info() == Eigen::Success ? Vector3d(svd.singularValues()) : Vector3d::Constant(kNaN);
}

double row_backward_error(const Eigen::VectorXd& sum, const Eigen::VectorXd& terms) {
  double largest = 0;
  for (Index i = 0; i < sum.size(); ++i) {
    if (sum[i] == 0 && terms[i] >= 0) continue;
    largest = nan_max(largest, std::abs(sum[i]) / terms[i]);
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace trammel::solver
