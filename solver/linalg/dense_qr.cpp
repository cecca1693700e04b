#include "solver/linalg/dense_qr.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "solver/model/numbers.h"

namespace trammel::solver {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

ThinQr thin_qr(const MatrixXd& A) {
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  return {qr.householderQ() * MatrixXd::Identity(A.rows(), A.cols()),
          qr.matrixQR().topRows(A.cols())};
}

MatrixXd range_basis(const MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  return qr.householderQ() * MatrixXd::Identity(A.rows(), qr.rank());
}

PivotedSolution pivoted_solve(const Matrix3d& A, const Vector3d& b) {
  const Eigen::ColPivHouseholderQR<Matrix3d> qr(A);
  return {qr.solve(b), std::abs(qr.matrixR()(2, 2)) / std::abs(qr.matrixR()(0, 0))};
}

RightSingularVectors right_singular_vectors(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinV);
  if (svd.info() == Eigen::Success) return {true, svd.singularValues(), svd.matrixV()};
  const Index size = std::min(A.rows(), A.cols());
  return {false, VectorXd::Constant(size, kNaN), MatrixXd::Constant(A.cols(), size, kNaN)};
}

Vector3d singular_values(const Matrix3d& A) {
  const Eigen::JacobiSVD<Matrix3d> svd(A);
  return svd.info() == Eigen::Success ? Vector3d(svd.singularValues()) : Vector3d::Constant(kNaN);
}

}  // namespace trammel::solver
