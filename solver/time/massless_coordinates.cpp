#include "solver/time/massless_coordinates.h"

#include <algorithm>
#include <limits>

#include "solver/time/transient_start.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// The least ratio of two diagonals where both are positive, so that what is added is small
/// compared with every mass, also if a step lasts many periods.
double least_ratio(const SparseMatrix& M, const SparseMatrix& added) {
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
    share_ = kShare * std::min(damped ? h : h * h, least_ratio(matrices.M(), added));
    SparseMatrix sum = matrices.M();
    sum += share_ * added;
    ++counters.factorizations;
    factored_ = factor_.factorize(sum) && factor_.smallest_to_largest_pivot() > kSingularMass;
    if (factored_) break;
  }
  return factored_;
}

void MasslessCoordinates::balance(const VectorXd& residual, VectorXd& x) {
  // (M + share B) s = residual moves masses as well, (M + share B) w = M s by as much alone.
  factor_.solve(residual, s_);
  const VectorXd image = matrices_->M() * s_;
  factor_.solve(image, w_);
  counters_->solves += 2;
  x += share_ * (s_ - w_);
}

void MasslessCoordinates::settle(TransientState& state, const VectorXd& rate) {
  const SparseMatrix &C = matrices_->C(), &K = matrices_->K();
  const VectorXd residual = state.f - C * state.v - K * state.q;
  balance(residual, damped_ ? state.v : state.q);
  if (!damped_) balance(rate - K * state.v, state.v);
  const VectorXd left = state.f - C * state.v - K * state.q;
  factor_.solve(left, state.a);
  factor_.solve(left - matrices_->M() * state.a, s_);
  counters_->solves += 2;
  state.a += s_;
  accelerate(state, rate);
}

void MasslessCoordinates::follow(TransientState& state, const VectorXd& rate) {
  if (!damped_) balance(rate - matrices_->K() * state.v, state.v);
  accelerate(state, rate);
}

void MasslessCoordinates::accelerate(TransientState& state, const VectorXd& rate) {
  if (damped_) {
    balance(rate - matrices_->K() * state.v - matrices_->C() * state.a, state.a);
  } else {
    balance(-(matrices_->K() * state.a), state.a);
  }
}

}  // namespace trammel::solver
