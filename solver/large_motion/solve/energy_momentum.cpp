#include "solver/large_motion/solve/energy_momentum.h"

#include <cmath>

#include "solver/large_motion/solve/start.h"

namespace trammel::large {

EnergyMomentum::EnergyMomentum(const ConservativeSystem& system)
    : system_(system),
      matrix_(system.coordinates(), system.constraints(), system.blocks()),
      gap_(VectorXd::Zero(system.constraints())),
      rate_(VectorXd::Zero(system.constraints())),
      gap_before_(VectorXd::Zero(system.constraints())),
      step_(VectorXd::Zero(system.coordinates() + system.constraints())) {}

void EnergyMomentum::begin(const State& state) {
  from_ = to_ = middle_ = state;
  mean_ = last_mean_ = state.lambda;
  factored_step_ = 0;
  first_ = true;
}

void EnergyMomentum::accept() {
  std::swap(from_, to_);
  std::swap(last_mean_, mean_);
  last_step_ = from_.t - to_.t;
  first_ = false;
}

bool EnergyMomentum::factor(double h, bool exact) {
  middle_.t = (from_.t + to_.t) / 2;
  middle_.load = (from_.load + to_.load) / 2;
  middle_.gravity = to_.gravity;
  middle_.q = (from_.q + to_.q) / 2;
  middle_.lambda = mean_;
  const double per_acceleration = 2 / (h * h);
  Weights weights;
  weights.mass = 1;
  weights.damping = h / 2;
  weights.stiffness = h * h / 4;
  weights.compliance = per_acceleration / (0.5 + system_.strain_rate_damping() / h);
  matrix_.clear();
  factored_step_ = h;
  if (exact) {
    system_.secant_tangent(from_, to_, middle_, weights, matrix_);
    return matrix_.factor(false);
  }
  system_.tangent(middle_, weights, matrix_);
  return matrix_.factor(system_.symmetric());
}

void EnergyMomentum::residuals(double h) {
  const Index n = system_.coordinates();
  const double tau = system_.strain_rate_damping();
  system_.secant_balance(from_, to_, mean_, step_.head(n));
  step_.head(n) *= -h * h / 2;
  system_.gaps(to_, gap_, rate_);
  for (Index r = 0; r < system_.constraints(); ++r) {
    const double c = system_.compliance()[r];
    if (c > 0) {
      const double mean = (gap_before_[r] + gap_[r]) / 2;
      const double change = tau / h * (gap_[r] - gap_before_[r]);
      step_[n + r] = -(mean + change - c * mean_[r]) / (0.5 + tau / h);
    } else {
      step_[n + r] = -gap_[r];
    }
  }
}

/// Elastic rows from the strain itself, rigid ones by extrapolation from the steps' means.
void EnergyMomentum::set_end_multipliers(double h) {
  const double tau = system_.strain_rate_damping();
  const double ahead = first_ ? 1.0 : h / (h + last_step_);
  system_.gaps(to_, gap_, rate_);
  to_.lambda = mean_ + ahead * (mean_ - last_mean_);
  for (Index r = 0; r < system_.constraints(); ++r) {
    const double c = system_.compliance()[r];
    if (c > 0) to_.lambda[r] = (gap_[r] + tau * rate_[r]) / c;
  }
}

StepReport EnergyMomentum::attempt(double h) {
  StepReport report = newton(h, false);
  if (report.converged) return report;
  const int spent = report.iterations;
  report = newton(h, true);
  report.iterations += spent;
  factored_step_ = 0;
  return report;
}

StepReport EnergyMomentum::newton(double h, bool exact) {
  StepReport report;
  const Index n = system_.coordinates(), m = system_.constraints();
  system_.gaps(from_, gap_before_, rate_);
  to_.t = from_.t + h;
  to_.load = system_.load_factor(to_.t);
  to_.gravity = from_.gravity;
  to_.q = from_.q + h * from_.v + h * h / 2 * from_.a;
  to_.v = 2 / h * (to_.q - from_.q) - from_.v;
  mean_ = last_mean_;
  StepConvergence convergence;
  bool fresh = false;
  for (int i = 0; i < 30; ++i) {
    if (exact || factored_step_ != h || (!fresh && convergence.slow())) {
      if (!factor(h, exact)) return report;
      fresh = true;
    }
    residuals(h);
    matrix_.solve(step_);
    if (!step_.allFinite()) return report;
    to_.q += step_.head(n);
    to_.v += 2 / h * step_.head(n);
    mean_ += 2 / (h * h) * step_.tail(m);
    report.iterations = i + 1;
    const double moved = weighted_size(system_, step_.head(n));
    convergence.record(moved, 0);
    report.residual = moved;
    to_.a = (to_.v - from_.v) / h;
    // Energy leaks by what Newton leaves, so nearly to round-off.
    if (convergence.done(1e-4 * h * h * weighted_size(system_, to_.a),
                         h * weighted_size(system_, to_.v), weighted_size(system_, to_.q))) {
      change_ = to_.a - from_.a;
      report.error = first_ ? 0.0 : h * h / 12 * weighted_size(system_, change_);
      set_end_multipliers(h);
      report.converged = true;
      if (i > 4) factored_step_ = 0;
      return report;
    }
    if (convergence.hopeless()) return report;
  }
  return report;
}

}  // namespace trammel::large
