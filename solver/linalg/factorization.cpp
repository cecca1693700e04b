#include "solver/linalg/factorization.h"

#include <cmath>

namespace trammel::solver {

using Eigen::VectorXd;

void Factorization::compute(const SparseMatrix& A) {
  scaling_ =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
  SparseMatrix scaled = A;
  for (Index j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(scaled, j); it; ++it)
      it.valueRef() *= scaling_[it.row()] * scaling_[j];
  }
  exists_ = ldlt_.factorize(scaled);
}

std::optional<Index> Factorization::inertia(const SparseMatrix& A) {
  compute(A);
  return is_reliable() ? std::optional(negative_pivots()) : std::nullopt;
}

double Factorization::smallest_pivot() const {
  const VectorXd& D = ldlt_.pivots();
  return D.size() == 0 ? 1.0 : D.minCoeff();
}

VectorXd Factorization::solve(const VectorXd& b) const {
  VectorXd x;
  ldlt_.solve(scaling_.cwiseProduct(b), x);
  return scaling_.cwiseProduct(x);
}

VectorXd Factorization::solve_half(const VectorXd& b) const {
  return ldlt_.solve_half(scaling_.cwiseProduct(b));
}

VectorXd Factorization::solve_half_transposed(const VectorXd& y) const {
  VectorXd x = ldlt_.solve_half_transposed(y);
  x.array() *= scaling_.array();
  return x;
}

}  // namespace trammel::solver
