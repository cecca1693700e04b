#include "solver/time/transient_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "solver/linalg/sparse_ldlt.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// K q = f; the skew part of K, if any, by refinement.
void solve_refined(const SparseMatrix& K, SparseLdlt& factor, const VectorXd& f, VectorXd& q,
                   Counters& counters) {
  VectorXd correction;
  q.setZero();
  for (int pass = 0; pass < 4; ++pass) {
    VectorXd residual = f;
    residual.noalias() -= K * q;
    factor.solve(residual, correction);
    q += correction;
    ++counters.solves;
  }
}

}  // namespace

double smooth_span(const std::vector<double>& breakpoints, const TransientOptions& options) {
  constexpr double kBefore = 0.999;  // at a jump the load has the value after it
  double span = std::min(options.step, options.end - options.start);
  for (const double time : breakpoints)
    if (time > options.start) span = std::min(span, kBefore * (time - options.start));
  return span;
}

Outcome start_quasi_statically(EquationMatrices& matrices, const TransientOptions& options,
                               VectorXd& q, VectorXd& v, Counters& counters) {
  constexpr std::array<double, 5> kSlope = {-25.0 / 12, 4, -3, 4.0 / 3, -0.25};
  const double gap = smooth_span(matrices.breakpoints(), options) / 4;
  SparseLdlt factor(SparseLdlt::Triangle::mean);
  VectorXd f(q.size()), q_then(q.size());
  v.setZero();
  for (int i = 4; i >= 0; --i) {
    const double time = options.start + i * gap;
    matrices.update(time);
    if (i == 4 || !matrices.constant()) {
      ++counters.factorizations;
      if (!factor.factorize(matrices.K()) || factor.smallest_to_largest_pivot() < kSingularMass) {
        return {Status::singular, "the stiffness is singular: there is no quasi-static start"};
      }
    }
    matrices.load(time, f);
    solve_refined(matrices.K(), factor, f, q_then, counters);
    v += (kSlope[static_cast<std::size_t>(i)] / gap) * q_then;
  }
  f.noalias() -= matrices.C() * v;
  solve_refined(matrices.K(), factor, f, q, counters);
  return {};
}

Outcome check_stability(const EquationMatrices& matrices, const TransientOptions& options,
                        Counters& counters) {
  const double limit = stability_limit(options.scheme);
  if (!std::isfinite(limit) || matrices.M().rows() == 0) return {};
  SparseLdlt factor(SparseLdlt::Triangle::mean);
  ++counters.factorizations;
  if (!factor.factorize(matrices.M()) || factor.smallest_to_largest_pivot() < kSingularMass) {
    return {Status::singular,
            "the mass is singular: a conditionally stable scheme has no stable step"};
  }
  VectorXd x(matrices.M().rows()), Kx;
  for (Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + 3.7 * static_cast<double>(i));
  double squared = 0;
  for (int i = 0; i < 60; ++i) {
    x /= std::sqrt(x.dot(matrices.M() * x));
    Kx.noalias() = matrices.K() * x;
    squared = std::max(squared, x.dot(Kx));
    factor.solve(Kx, x);
    ++counters.solves;
    if (!(x.squaredNorm() > 0)) break;
  }
  const double phase = std::sqrt(squared) * options.step;
  if (phase <= limit) return {};
  std::ostringstream message;
  message << "the step h = " << options.step
          << " s is unstable: the fastest motion has w h = " << phase << ", the scheme bears "
          << limit << "; take h below " << options.step * limit / phase << " s";
  return {Status::not_converged, message.str()};
}

}  // namespace trammel::solver
