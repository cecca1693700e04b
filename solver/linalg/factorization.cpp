#include "solver/linalg/factorization.h"

#include <algorithm>
#include <cmath>
#include <iostream>  // MetisSupport needs it
#include <mutex>

// after <iostream>
#include <Eigen/MetisSupport>
#include <Eigen/OrderingMethods>

namespace trammel::solver {

using Eigen::Index;
using Eigen::VectorXd;

void FillReducingOrdering::operator()(const Eigen::SparseMatrix<double>& matrix,
                                      PermutationType& permutation) const {
  constexpr Index kSmall = 5000;
  if (matrix.rows() < kSmall) {
    Eigen::AMDOrdering<int>()(matrix, permutation);
  } else {
    // METIS seeds and draws from the one random sequence of the process.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    Eigen::MetisOrdering<int>()(matrix, permutation);
  }
}

void Factorization::compute(const Eigen::SparseMatrix<double>& A) {
  scaling_ =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
  Eigen::SparseMatrix<double> scaled = A;
  norm_ = 0;
  for (Index j = 0; j < A.cols(); ++j) {
    double column = 0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(scaled, j); it; ++it) {
      it.valueRef() *= scaling_[it.row()] * scaling_[j];
      column += std::abs(it.value());
    }
    norm_ = std::max(norm_, column);
  }
  if (!has_pattern_of(scaled)) {
    ldlt_.analyzePattern(scaled);
    columns_.assign(scaled.outerIndexPtr(), scaled.outerIndexPtr() + scaled.cols() + 1);
    rows_.assign(scaled.innerIndexPtr(), scaled.innerIndexPtr() + scaled.nonZeros());
  }
  ldlt_.factorize(scaled);
  exists_ = ldlt_.info() == Eigen::Success && ldlt_.vectorD().allFinite();
}

bool Factorization::has_pattern_of(const Eigen::SparseMatrix<double>& A) const {
  return columns_.size() == static_cast<std::size_t>(A.cols()) + 1 &&
         std::equal(columns_.begin(), columns_.end(), A.outerIndexPtr()) &&
         std::equal(rows_.begin(), rows_.end(), A.innerIndexPtr());
}

double Factorization::smallest_pivot() const {
  return ldlt_.vectorD().size() == 0 ? 1.0 : ldlt_.vectorD().minCoeff();
}

Index Factorization::negative_pivots() const {
  return (ldlt_.vectorD().array() < 0).count();
}

double Factorization::element_growth() const {
  const auto& L = ldlt_.matrixL().nestedExpression();
  double largest = 0;
  for (Index j = 0; j < L.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(L, j); it; ++it) {
      largest = std::max(largest, std::abs(it.value()));
    }
  }
  return largest;
}

VectorXd Factorization::solve(const VectorXd& b) const {
  const VectorXd scaled = scaling_.cwiseProduct(b);
  const VectorXd solution = ldlt_.solve(scaled);
  return scaling_.cwiseProduct(solution);
}

VectorXd Factorization::solve_half(const VectorXd& b) const {
  VectorXd y = ldlt_.permutationP() * scaling_.cwiseProduct(b);
  ldlt_.matrixL().solveInPlace(y);
  return y.cwiseQuotient(ldlt_.vectorD().cwiseSqrt());
}

VectorXd Factorization::solve_half_transposed(const VectorXd& y) const {
  VectorXd x = y.cwiseQuotient(ldlt_.vectorD().cwiseSqrt());
  ldlt_.matrixU().solveInPlace(x);
  return scaling_.cwiseProduct(ldlt_.permutationPinv() * x);
}

double Factorization::condition() const {
  const Index n = scaling_.size();
  if (n == 0) return 1;
  VectorXd x = VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  double estimate = 0;
  for (int step = 0; step < 5; ++step) {
    const VectorXd y = ldlt_.solve(x);
    const double norm = y.lpNorm<1>();
    if (step > 0 && norm <= estimate) break;
    estimate = norm;
    const VectorXd sign = y.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
    const VectorXd z = ldlt_.solve(sign);
    Index next = 0;
    const double largest = z.cwiseAbs().maxCoeff(&next);
    if (step > 0 && largest <= z.dot(x)) break;
    x.setZero();
    x[next] = 1;
  }
  return estimate * norm_;
}

}  // namespace trammel::solver
