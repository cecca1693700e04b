#include "solver/linalg/sparse_lu.h"

#include <Eigen/SparseLU>
#include <complex>

namespace trammel::solver {

template <class Scalar>
struct SparseLu<Scalar>::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Scalar>, Eigen::COLAMDOrdering<int>> lu;
  bool analyzed = false;
};

template <class Scalar>
SparseLu<Scalar>::SparseLu() : factors_(new Factors, [](Factors* factors) { delete factors; }) {}

template <class Scalar>
bool SparseLu<Scalar>::factorize(const Eigen::SparseMatrix<Scalar>& A) {
  if (!Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).allFinite()) return false;
  if (!factors_->analyzed) factors_->lu.analyzePattern(A);
  factors_->analyzed = true;
  factors_->lu.factorize(A);
  return factors_->lu.info() == Eigen::Success;
}

template <class Scalar>
typename SparseLu<Scalar>::Vector SparseLu<Scalar>::solve(const Vector& b) const {
  return factors_->lu.solve(b);
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

}  // namespace trammel::solver
