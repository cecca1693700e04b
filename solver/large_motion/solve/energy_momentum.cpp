#include "solver/large_motion/solve/energy_momentum.h"

#include <algorithm>
#include <cmath>

#include "solver/large_motion/solve/step_convergence.h"

namespace trammel::solver::large_motion {

EnergyMomentum::EnergyMomentum(const ConservativeSystem& system)
    : system_(system),
      matrix_(system.coordinates(), system.constraints(), system.blocks()),
      constraint_residual_(VectorXd::Zero(system.constraints())),
      constraint_rate_(VectorXd::Zero(system.constraints())),
      previous_constraint_residual_(VectorXd::Zero(system.constraints())),
      step_(VectorXd::Zero(system.coordinates() + system.constraints())) {}

void EnergyMomentum::begin(const State& state) {
  from_ = to_ = midpoint_ = state;
  mean_lambda_ = previous_mean_lambda_ = state.lambda;
  factored_step_ = 0;
  first_ = true;
  energy_step_.after = system_.energy(state);
}

void EnergyMomentum::accept() {
  std::swap(from_, to_);
  std::swap(previous_mean_lambda_, mean_lambda_);
  last_step_ = from_.t - to_.t;
  first_ = false;
  energy_step_ = {energy_step_.after, system_.energy(from_),
                  system_.nonconservative_work(to_, from_, previous_mean_lambda_)};
}

bool EnergyMomentum::factor(double h, bool exact) {
  midpoint_.t = (from_.t + to_.t) / 2;
  midpoint_.load = (from_.load + to_.load) / 2;
  midpoint_.gravity = to_.gravity;
  midpoint_.q = (from_.q + to_.q) / 2;
  midpoint_.lambda = mean_lambda_;
  const double per_acceleration = 2 / (h * h);
  TangentCoefficients coefficients;
  coefficients.mass = 1;
  coefficients.damping = h / 2;
  coefficients.stiffness = h * h / 4;
  coefficients.compliance = per_acceleration / (0.5 + system_.strain_rate_damping() / h);
  matrix_.clear();
  factored_step_ = h;
  if (exact) {
    system_.discrete_gradient_tangent(from_, to_, midpoint_, coefficients, matrix_);
    return matrix_.factor(false);
  }
  system_.tangent(midpoint_, coefficients, matrix_);
  return matrix_.factor(system_.symmetric());
}

void EnergyMomentum::compute_residuals(double h) {
  const Index n = system_.coordinates();
  const double tau = system_.strain_rate_damping();
  system_.discrete_gradient_residual(from_, to_, mean_lambda_, step_.head(n));
  step_.head(n) *= -h * h / 2;
  system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
  for (Index r = 0; r < system_.constraints(); ++r) {
    const double c = system_.compliance()[r];
    if (c > 0) {
      const double mean = (previous_constraint_residual_[r] + constraint_residual_[r]) / 2;
      const double change = tau / h * (constraint_residual_[r] - previous_constraint_residual_[r]);
      step_[n + r] = -(mean + change - c * mean_lambda_[r]) / (0.5 + tau / h);
    } else {
      step_[n + r] = -constraint_residual_[r];
    }
  }
}

/// Elastic rows from the strain itself, rigid ones by extrapolation from the steps' means.
void EnergyMomentum::set_end_multipliers(double h) {
  const double tau = system_.strain_rate_damping();
  const double extrapolation = first_ ? 1.0 : h / (h + last_step_);
  system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
  to_.lambda = mean_lambda_ + extrapolation * (mean_lambda_ - previous_mean_lambda_);
  for (Index r = 0; r < system_.constraints(); ++r) {
    const double c = system_.compliance()[r];
    if (c > 0) to_.lambda[r] = (constraint_residual_[r] + tau * constraint_rate_[r]) / c;
  }
}

StepReport EnergyMomentum::attempt(double h, double end) {
  end_ = end;
  StepReport report = newton(h, false);
  if (report.converged) return report;
  const int spent = report.iterations;
  report = newton(h, true);
  report.iterations += spent;
  factored_step_ = 0;
  return report;
}

void EnergyMomentum::predict(double h) {
  system_.constraint_residual(from_, previous_constraint_residual_, constraint_rate_);
  to_.t = end_;
  to_.load = system_.load_factor(to_.t);
  to_.gravity = from_.gravity;
  to_.q = from_.q + h * from_.v + h * h / 2 * from_.a;
  to_.v = 2 / h * (to_.q - from_.q) - from_.v;
  mean_lambda_ = previous_mean_lambda_;
}

StepReport EnergyMomentum::newton(double h, bool exact) {
  StepReport report;
  const Index n = system_.coordinates(), m = system_.constraints();
  predict(h);
  StepConvergence convergence;
  bool fresh = false;
  for (int i = 0; i < 30; ++i) {
    if (exact || factored_step_ != h || (!fresh && convergence.slow())) {
      if (!factor(h, exact)) return report;
      fresh = true;
    }
    compute_residuals(h);
    matrix_.solve(step_);
    if (!step_.allFinite()) return report;
    to_.q += step_.head(n);
    to_.v += 2 / h * step_.head(n);
    mean_lambda_ += 2 / (h * h) * step_.tail(m);
    report.iterations = i + 1;
    const double correction = weighted_rms_norm(system_, step_.head(n));
    convergence.record(correction, 0);
    report.correction = correction;
    to_.a = (to_.v - from_.v) / h;
    // What Newton's method leaves is lost or gained energy: it iterates to a tenth of what is lost
    // in storing the positions.
    const double acceleration = 1e-4 * h * h * weighted_rms_norm(system_, to_.a);
    const double position = weighted_rms_norm(system_, to_.q);
    if (convergence.converged(acceleration, h * weighted_rms_norm(system_, to_.v), position,
                              std::max(1e-11 * acceleration, 1e-17 * position))) {
      change_ = to_.a - from_.a;
      report.error = first_ ? 0.0 : h * h / 12 * weighted_rms_norm(system_, change_);
      set_end_multipliers(h);
      change_ = to_.q - from_.q - h / 2 * (from_.v + to_.v);
      const double moved =
          h * (weighted_rms_norm(system_, from_.v) + weighted_rms_norm(system_, to_.v));
      const double size =
          weighted_rms_norm(system_, to_.q) + weighted_rms_norm(system_, from_.q) + moved;
      relation_residual_ = size > 0 ? weighted_rms_norm(system_, change_) / size : 0;
      report.converged = true;
      if (i > 4) factored_step_ = 0;
      return report;
    }
    if (convergence.diverging()) return report;
  }
  return report;
}

}  // namespace trammel::solver::large_motion
