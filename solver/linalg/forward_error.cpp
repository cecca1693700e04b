#include "solver/linalg/forward_error.h"

#include <cfenv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

// Factor of the unknowns s in the augmented system C^-1 s = A q, A^T s = f. The factor is far below
// the relevant singular values of the scaled A. Row exchanges therefore select pivots from A, and
// the elimination does not form K.
// Source: Bjorck (1996), ch. 2.5.3, alpha.
constexpr double kAlpha = 1e-12;

}  // namespace

AugmentedSystem::AugmentedSystem(FactoredStiffness factors)
    : factors_(std::move(factors)), root_(factors_.C.cwiseSqrt()) {
  const Index m = factors_.A.rows(), n = factors_.A.cols();
  SparseMatrix G = root_.asDiagonal() * factors_.A;
  scaling_.resize(n);
  for (Index j = 0; j < n; ++j) scaling_[j] = G.col(j).norm() > 0 ? 1 / G.col(j).norm() : 1.0;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < m; ++i) entries.emplace_back(i, i, -kAlpha);
  for (Index j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator it(G, j); it; ++it) {
      entries.emplace_back(it.row(), m + j, it.value() * scaling_[j]);
      entries.emplace_back(m + j, it.row(), it.value() * scaling_[j]);
    }
  }
  SparseMatrix matrix(m + n, m + n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  exists_ = lu_.factorize(matrix);
}

RefinedSolution AugmentedSystem::solve(const VectorXd& f) const {
  constexpr int kMaxSteps = 8;
  const auto& [A, size, C] = factors_;
  const Index m = A.rows(), n = A.cols();
  RefinedSolution result{VectorXd::Zero(n), 1};
  VectorXd s = VectorXd::Zero(m), rhs(m + n);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    rhs.head(m) = root_.cwiseProduct(s.cwiseQuotient(C) - A * result.x);
    rhs.tail(n) = scaling_.cwiseProduct(f - A.transpose() * s) / kAlpha;
    const VectorXd z = lu_.solve(rhs);
    const VectorXd correction = scaling_.cwiseProduct(z.tail(n));
    const double change = correction.norm();
    if (!(change < last)) break;
    result.x += correction;
    s += kAlpha * root_.cwiseProduct(z.head(m));
    const double whole = result.x.norm();
    result.correction = step == 0 || change == 0 ? (change > 0) : change / whole;
    if (change == 0 || (step > 0 && (change <= kEps * whole || change > 0.5 * last))) break;
    last = change;
  }
  return result;
}

double estimate_norm(Index columns, const std::function<VectorXd(const VectorXd&)>& B,
                     const std::function<VectorXd(const VectorXd&)>& Bt) {
  if (columns == 0) return 0;
  VectorXd x = VectorXd::Constant(columns, 1.0 / static_cast<double>(columns));
  double estimate = 0;
  for (int step = 0; step < 5; ++step) {
    const VectorXd y = B(x);
    const double norm = y.lpNorm<1>();
    if (!std::isfinite(norm)) return norm;
    if (step > 0 && norm <= estimate) break;
    estimate = norm;
    const VectorXd z = Bt(y.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; }));
    Index next = 0;
    const double largest = z.cwiseAbs().maxCoeff(&next);
    if (step > 0 && largest <= z.dot(x)) break;
    x.setZero();
    x[next] = 1;
  }
  return estimate;
}

double forward_error(const FactoredStiffness& factors, const SparseMatrix& R, const VectorXd& q,
                     const VectorXd& f, const Operator& solve) {
  const SparseMatrix &A = factors.A, &size = factors.size;
  const VectorXd& C = factors.C;
  const SparseMatrix ones = size.unaryExpr([](double v) { return v > 0 ? 1.0 : 0.0; });
  const Index m = A.rows(), n = A.cols();
  const double u = std::fegetround() == FE_TONEAREST ? kEps / 2 : kEps;
  const VectorXd in_row = ((ones * VectorXd::Ones(n)).array() + 1).sqrt();
  const VectorXd in_column = ((ones.transpose() * VectorXd::Ones(m)).array() + 1).sqrt();
  const VectorXd g = u * in_row.cwiseProduct(size * q.cwiseAbs());
  const VectorXd s = C.cwiseProduct(A * q);
  const VectorXd h = u * in_column.cwiseProduct(size.transpose() * s.cwiseAbs() + f.cwiseAbs());
  const auto transposed = [&](const VectorXd& x) -> VectorXd {
    const VectorXd p = solve(R.transpose() * x);
    VectorXd y(m + n);
    y << g.cwiseProduct(C.cwiseProduct(A * p)), h.cwiseProduct(p);
    return y;
  };
  const auto direct = [&](const VectorXd& y) -> VectorXd {
    const VectorXd d = C.cwiseProduct(g.cwiseProduct(y.head(m)));
    return R * solve(A.transpose() * d + h.cwiseProduct(y.tail(n)));
  };
  const double largest = (R * q).lpNorm<Eigen::Infinity>();
  return largest == 0 ? 0 : estimate_norm(R.rows(), transposed, direct) / largest;
}

}  // namespace trammel::solver
