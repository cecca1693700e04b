#include "solver/linalg/forward_error.h"

#include <cfenv>
#include <cmath>

namespace trammel::solver {

using Eigen::VectorXd;

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

double forward_error(const StiffnessFactors& factors, const SparseMatrix& R, const VectorXd& q,
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
