#include "solver/linalg/dense_eigen.h"

#include <Eigen/Eigenvalues>

#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

template <class Matrix, class Eigensolver>
SymmetricEigenpairs<Matrix> result_of(const Eigensolver& solver, Index size, bool positive) {
  SymmetricEigenpairs<Matrix> pairs;
  pairs.converged = positive && solver.info() == Eigen::Success;
  if (pairs.converged) {
    pairs.value = solver.eigenvalues();
    pairs.vector = solver.eigenvectors();
  } else {
    pairs.value.setConstant(size, kNaN);
    pairs.vector.setConstant(size, size, kNaN);
  }
  return pairs;
}

}  // namespace

template <class Matrix>
SymmetricEigenpairs<Matrix> symmetric_eigenpairs(const Matrix& A) {
  if (A.size() == 0) return {true, {}, {}};
  return result_of<Matrix>(Eigen::SelfAdjointEigenSolver<Matrix>(A), A.rows(), true);
}
template SymmetricEigenpairs<Eigen::Matrix3d> symmetric_eigenpairs(const Eigen::Matrix3d&);
template SymmetricEigenpairs<Eigen::MatrixXd> symmetric_eigenpairs(const Eigen::MatrixXd&);
template SymmetricEigenpairs<Eigen::MatrixXcd> symmetric_eigenpairs(const Eigen::MatrixXcd&);

SymmetricEigenpairs<Eigen::MatrixXd> symmetric_eigenpairs(const Eigen::MatrixXd& A,
                                                          const Eigen::MatrixXd& B) {
  if (A.size() == 0) return {true, {}, {}};
  // Eigen factors B too, but does not say whether that succeeded.
  const bool positive = Eigen::LLT<Eigen::MatrixXd>(B).info() == Eigen::Success;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, B);
  return result_of<Eigen::MatrixXd>(solver, A.rows(), positive);
}

ComplexEigenpairs eigenpairs(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() == Eigen::Success) return {true, solver.eigenvalues(), solver.eigenvectors()};
  return {false, Eigen::VectorXcd::Constant(A.rows(), kNaN),
          Eigen::MatrixXcd::Constant(A.rows(), A.rows(), kNaN)};
}

double spectral_radius(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  return solver.info() == Eigen::Success ? solver.eigenvalues().cwiseAbs().maxCoeff() : kNaN;
}

}  // namespace trammel::solver
