#include "solver/linalg/augmented_system.h"

#include <limits>
#include <utility>
#include <vector>

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

// Scales s: far below the singular values of the scaled A that matter, so that row exchanges take
// pivots from A and K is not formed on the way.   Source: Bjorck (1996), ch. 2.5.3
constexpr double kAlpha = 1e-12;

}  // namespace

AugmentedSystem::AugmentedSystem(StiffnessFactors factors)
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

}  // namespace trammel::solver
