#include "solver/motion/transient_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "solver/linalg/factorization.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// Solves K q = f. Iterative refinement takes the skew-symmetric part of K into account, which is
/// not factored.
void solve_with_refinement(const SparseMatrix& K, SparseLdlt& factor, const VectorXd& f,
                           VectorXd& q, Counters& counters) {
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

double smooth_load_interval(const std::vector<double>& breakpoints,
                            const TransientOptions& options) {
  // Fraction of the time from the start to a breakpoint in which the load is treated as smooth. The
  // fraction is below 1, because the load at a jump has the value after the jump.
  constexpr double kBefore = 0.999;
  double span = std::min(options.step, options.end - options.start);
  for (const double time : breakpoints)
    if (time > options.start) span = std::min(span, kBefore * (time - options.start));
  return span;
}

Outcome start_quasi_statically(EquationMatrices& matrices, const TransientOptions& options,
                               VectorXd& q, VectorXd& v, Counters& counters) {
  constexpr std::array<double, 5> kSlope = {-25.0 / 12, 4, -3, 4.0 / 3, -0.25};
  const double gap = smooth_load_interval(matrices.breakpoints(), options) / 4;
  SparseLdlt factor(SparseLdlt::Triangle::mean);
  VectorXd f(q.size()), q_then(q.size());
  v.setZero();
  for (int i = 4; i >= 0; --i) {
    const double time = options.start + i * gap;
    matrices.update(time);
    if (i == 4 || !matrices.is_constant()) {
      ++counters.factorizations;
      if (!factor.factorize(matrices.K()) || factor.smallest_pivot_to_diagonal() < kSingularMass)
        return {Status::singular, "the stiffness is singular, so there is no quasi-static start"};
    }
    matrices.compute_load(time, f);
    solve_with_refinement(matrices.K(), factor, f, q_then, counters);
    v += (kSlope[static_cast<std::size_t>(i)] / gap) * q_then;
  }
  f.noalias() -= matrices.C() * v;
  solve_with_refinement(matrices.K(), factor, f, q, counters);
  return {};
}

Outcome check_time_step_stability(const EquationMatrices& matrices, const TransientOptions& options,
                                  Counters& counters) {
  const double limit = stability_limit(options.scheme);
  if (!std::isfinite(limit) || matrices.M().rows() == 0) return {};
  SparseLdlt factor(SparseLdlt::Triangle::mean);
  ++counters.factorizations;
  if (!factor.factorize(matrices.M()) || factor.smallest_pivot_to_diagonal() < kSingularMass)
    return {Status::singular,
            "the mass is singular: a conditionally stable scheme has no stable step"};
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
          << " s is unstable: the highest frequency w has w h = " << phase
          << ", but the stability limit of the scheme is " << limit << "; use h below "
          << options.step * limit / phase << " s";
  return {Status::not_converged, message.str()};
}

namespace {

/// Returns the smallest ratio of a diagonal entry of M to that of `added`, over all coordinates
/// with positive entries in both matrices. A much smaller multiple of `added` is negligible for
/// every mass, even if a step contains many periods.
double least_diagonal_ratio(const SparseMatrix& M, const SparseMatrix& added) {
  double least = std::numeric_limits<double>::infinity();
  const VectorXd mass = M.diagonal(), other = added.diagonal();
  for (Index i = 0; i < mass.size(); ++i)
    if (mass[i] > 0 && other[i] > 0) least = std::min(least, mass[i] / other[i]);
  return least;
}

}  // namespace

bool MasslessCoordinates::factor(const EquationMatrices& matrices, double h, Counters& counters) {
  constexpr double kShare = 1e-8;
  if (h == step_) return factored_;
  matrices_ = &matrices;
  counters_ = &counters;
  step_ = h;
  for (const bool damped : {true, false}) {
    damped_ = damped;
    if (damped && matrices.norm_C() == 0) continue;
    const SparseMatrix& added = damped ? matrices.C() : matrices.K();
    share_ = kShare * std::min(damped ? h : h * h, least_diagonal_ratio(matrices.M(), added));
    SparseMatrix sum = matrices.M();
    sum += share_ * added;
    ++counters.factorizations;
    factored_ = factor_.factorize(sum) && factor_.smallest_pivot_to_diagonal() > kSingularMass;
    if (factored_) break;
  }
  return factored_;
}

void MasslessCoordinates::add_balancing_motion(const VectorXd& residual, VectorXd& x) {
  // B is C or K, and share is a small factor. The solution s of (M + share B) s = residual moves
  // both massless coordinates and masses. The solution w of (M + share B) w = M s moves only
  // masses, by the same amount as s. s - w therefore moves only massless coordinates.
  factor_.solve(residual, s_);
  const VectorXd image = matrices_->M() * s_;
  factor_.solve(image, w_);
  counters_->solves += 2;
  x += share_ * (s_ - w_);
}

void MasslessCoordinates::equilibrate(TransientState& state, const VectorXd& df_dt) {
  const SparseMatrix &C = matrices_->C(), &K = matrices_->K();
  const VectorXd residual = state.f - C * state.v - K * state.q;
  add_balancing_motion(residual, damped_ ? state.v : state.q);
  if (!damped_) add_balancing_motion(df_dt - K * state.v, state.v);
  const VectorXd left = state.f - C * state.v - K * state.q;
  factor_.solve(left, state.a);
  factor_.solve(left - matrices_->M() * state.a, s_);
  counters_->solves += 2;
  state.a += s_;
  accelerate(state, df_dt);
}

void MasslessCoordinates::set_rates_from_positions(TransientState& state, const VectorXd& df_dt) {
  if (!damped_) add_balancing_motion(df_dt - matrices_->K() * state.v, state.v);
  accelerate(state, df_dt);
}

void MasslessCoordinates::accelerate(TransientState& state, const VectorXd& df_dt) {
  if (damped_) {
    add_balancing_motion(df_dt - matrices_->K() * state.v - matrices_->C() * state.a, state.a);
  } else {
    add_balancing_motion(-(matrices_->K() * state.a), state.a);
  }
}

}  // namespace trammel::solver
