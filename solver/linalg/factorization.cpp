#include "solver/linalg/factorization.h"

#include <algorithm>
#include <cmath>

namespace trammel::solver {

using Eigen::VectorXd;

void Factorization::compute(const SparseMatrix& A) {
  scaling_ =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
  SparseMatrix scaled = A;
  norm_ = 0;
  for (Index j = 0; j < A.cols(); ++j) {
    double column = 0;
    for (SparseMatrix::InnerIterator it(scaled, j); it; ++it) {
      it.valueRef() *= scaling_[it.row()] * scaling_[j];
      column += std::abs(it.value());
    }
    norm_ = std::max(norm_, column);
  }
  exists_ = ldlt_.factorize(scaled);
}

double Factorization::smallest_pivot() const {
  const VectorXd D = ldlt_.pivots();
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
  return scaling_.cwiseProduct(ldlt_.solve_half_transposed(y));
}

double Factorization::condition() const {
  const Index n = scaling_.size();
  if (n == 0) return 1;
  VectorXd x = VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  VectorXd y, z;
  double estimate = 0;
  for (int step = 0; step < 5; ++step) {
    ldlt_.solve(x, y);
    const double norm = y.lpNorm<1>();
    if (step > 0 && norm <= estimate) break;
    estimate = norm;
    ldlt_.solve(y.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; }), z);
    Index next = 0;
    const double largest = z.cwiseAbs().maxCoeff(&next);
    if (step > 0 && largest <= z.dot(x)) break;
    x.setZero();
    x[next] = 1;
  }
  return estimate * norm_;
}

}  // namespace trammel::solver
