#include "solver/large_motion/solve/generalized_alpha.h"

#include <algorithm>
#include <cmath>

#include "solver/large_motion/solve/step_convergence.h"
#include "solver/linalg/lanczos.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

GeneralizedAlpha::GeneralizedAlpha(const ConstrainedSystem& system, double spectral_radius)
    : system_(system),
      alpha_m_((2 * spectral_radius - 1) / (spectral_radius + 1)),
      alpha_f_(spectral_radius / (spectral_radius + 1)),
      beta_(std::pow(1 - alpha_m_ + alpha_f_, 2) / 4),
      gamma_(0.5 - alpha_m_ + alpha_f_),
      has_rigid_rows_((system.compliance().array() == 0).any()),
      matrix_(system.coordinates(), system.constraints(), system.blocks()),
      constraint_residual_(VectorXd::Zero(system.constraints())),
      constraint_rate_(VectorXd::Zero(system.constraints())),
      velocity_correction_(VectorXd::Zero(system.coordinates() + system.constraints())),
      position_correction_(VectorXd::Zero(system.coordinates() + system.constraints())) {}

void GeneralizedAlpha::begin(const State& state) {
  from_ = to_ = state;
  A0_ = A1_ = state.a;
  first_ = true;
  last_step_ = factored_step_ = 0;
}

void GeneralizedAlpha::accept() {
  std::swap(from_, to_);
  std::swap(A0_, A1_);
  last_step_ = from_.t - to_.t;
  first_ = false;
}

StepReport GeneralizedAlpha::attempt(double h, double end) {
  end_ = end;
  saved_A0_ = A0_;
  // A0 stands for the acceleration at t0 + (am - af) h.
  const double shift = alpha_m_ - alpha_f_;
  if (first_) {
    A0_ = from_.a;
    const StepReport trial = newton(h);
    if (!trial.converged) return trial;
    A0_ = from_.a + shift * (to_.a - from_.a);
  } else if (h != last_step_) {
    A0_ = from_.a + h / last_step_ * (A0_ - from_.a);
  }
  StepReport report = newton(h);
  report.error =
      std::abs(shift / 2 + beta_ - 1.0 / 6) * h * h * weighted_rms_norm(system_, A1_ - A0_);
  if (report.converged) relation_residual_ = relation_defect(h);
  // A rejected step must not scale A0 twice; an accepted one has no more use for it.
  A0_ = saved_A0_;
  return report;
}

double GeneralizedAlpha::relation_defect(double h) {
  const auto size = [this](const VectorXd& x) { return weighted_rms_norm(system_, x); };
  // A body that comes to rest has accelerations of round-off: that of the positions, over beta h^2.
  // Terms of which it is more than this share, a tenth of the residual's limit, have no digits.
  constexpr double kRoundoffShare = 1e-5;
  const double roundoff = kEps * (size(from_.q) + size(to_.q)) / (beta_ * h * h);
  const double A = size(A0_) + size(A1_) + roundoff / kRoundoffShare;
  const double a = size(from_.a) + size(to_.a) + A;
  const double v = size(from_.v) + size(to_.v) + h * A;
  const double q = size(from_.q) + size(to_.q) + h * v;
  const auto share = [&](double terms) {
    const double defect = size(defect_);
    return defect == 0 ? 0 : defect / terms;
  };
  defect_ = (1 - alpha_m_) * A1_ + alpha_m_ * A0_ - (1 - alpha_f_) * to_.a - alpha_f_ * from_.a;
  double largest = share(a);
  defect_ = to_.v - from_.v - h * ((1 - gamma_) * A0_ + gamma_ * A1_);
  largest = std::max(largest, share(v));
  if (system_.constraints() > 0 && !(system_.compliance().minCoeff() > 0)) return largest;
  defect_ = to_.q - from_.q - h * from_.v - h * h * ((0.5 - beta_) * A0_ + beta_ * A1_);
  return std::max(largest, share(q));
}

StepReport GeneralizedAlpha::newton(double h) {
  StepReport report = newton(h, false);
  if (report.converged) return report;
  const int spent = report.iterations;
  report = newton(h, true);
  report.iterations += spent;
  if (!report.converged) factored_step_ = 0;
  return report;
}

void GeneralizedAlpha::predict(double h) {
  to_.t = end_;
  to_.load = system_.load_factor(to_.t);
  to_.gravity = from_.gravity;
  to_.a = from_.a;
  to_.lambda = from_.lambda;
  A1_ = ((1 - alpha_f_) * to_.a + alpha_f_ * from_.a - alpha_m_ * A0_) / (1 - alpha_m_);
  to_.q = from_.q + h * from_.v + h * h * ((0.5 - beta_) * A0_ + beta_ * A1_);
  to_.v = from_.v + h * ((1 - gamma_) * A0_ + gamma_ * A1_);
}

bool GeneralizedAlpha::factor(double h) {
  const double per_acceleration = (1 - alpha_m_) / ((1 - alpha_f_) * beta_ * h * h);
  const double per_velocity = gamma_ / (beta_ * h);
  const double tau = system_.strain_rate_damping();
  TangentCoefficients coefficients;
  coefficients.mass = 1;
  coefficients.damping = per_velocity / per_acceleration;
  coefficients.stiffness = 1 / per_acceleration;
  coefficients.compliance = per_acceleration / (1 + tau * per_velocity);
  matrix_.clear();
  system_.tangent(to_, coefficients, matrix_);
  factored_step_ = h;
  return matrix_.factor(system_.symmetric());
}

/// One correction. The positions are solved for first, with the constraints themselves; then the
/// accelerations, with the rates that the new positions give. Both take the same matrix, the second
/// sees what the first has done, so the corrections shrink quadratically, next to a singular
/// position too. What the two differ by is p.
void GeneralizedAlpha::correct(double h) {
  const Index n = system_.coordinates(), m = system_.constraints();
  const double per_acceleration = (1 - alpha_m_) / ((1 - alpha_f_) * beta_ * h * h);
  const double per_velocity = gamma_ / (beta_ * h);
  const double tau = system_.strain_rate_damping();
  system_.force_residual(to_, velocity_correction_.head(n));
  velocity_correction_.head(n) /= -per_acceleration;
  system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
  position_correction_.head(n) = velocity_correction_.head(n);
  for (Index r = 0; r < m; ++r) {
    const double c = system_.compliance()[r];
    velocity_correction_[n + r] =
        c > 0 ? -(constraint_residual_[r] + tau * constraint_rate_[r] - c * to_.lambda[r]) /
                    (1 + tau * per_velocity)
              : -constraint_residual_[r];
    position_correction_[n + r] = velocity_correction_[n + r];
  }
  matrix_.solve(position_correction_);
  to_.q += position_correction_.head(n);
  if (has_rigid_rows_) {
    system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
    for (Index r = 0; r < m; ++r) {
      if (system_.compliance()[r] == 0)
        velocity_correction_[n + r] = -constraint_rate_[r] / per_velocity;
    }
    matrix_.solve(velocity_correction_);
  } else {
    velocity_correction_ = position_correction_;
  }
  to_.v += per_velocity * velocity_correction_.head(n);
  to_.a += per_acceleration * velocity_correction_.head(n);
  A1_ += 1 / (beta_ * h * h) * velocity_correction_.head(n);
  to_.lambda += per_acceleration * velocity_correction_.tail(m);
}

/// Size of a correction by the round-off errors of constraint forces and residuals, with arbitrary
/// signs. A small motion under large forces that balance each other, or near a singular position,
/// is not known better.
double GeneralizedAlpha::correction_roundoff(double h) const {
  const Index n = system_.coordinates(), m = system_.constraints();
  const double per_acceleration = (1 - alpha_m_) / ((1 - alpha_f_) * beta_ * h * h);
  VectorXd multipliers = VectorXd::Zero(n + m), errors(n + m);
  multipliers.tail(m) = to_.lambda / per_acceleration;
  matrix_.term_magnitudes(multipliers, errors);
  const double moved = weighted_rms_norm(system_, to_.q);
  errors.tail(m) = (system_.compliance().array() == 0).select(moved * system_.row_unit(), 0);
  errors = kEps * errors.cwiseProduct(start_vectors(n + m, 1));
  matrix_.solve(errors);
  return weighted_rms_norm(system_, errors.head(n));
}

StepReport GeneralizedAlpha::newton(double h, bool exact) {
  StepReport report;
  const Index n = system_.coordinates();
  predict(h);
  StepConvergence convergence;
  // Between the estimate for one rounding of each force and what several of them add up to.
  constexpr double kRoundoffErrors = 10;
  bool fresh = false;
  for (int i = 0; i < 20; ++i) {
    if (exact || factored_step_ != h || (!fresh && convergence.slow())) {
      if (!factor(h)) return report;
      fresh = true;
    }
    correct(h);
    if (!velocity_correction_.allFinite() || !position_correction_.allFinite()) return report;
    report.iterations = i + 1;
    convergence.record(
        weighted_rms_norm(system_, velocity_correction_.head(n)),
        weighted_rms_norm(system_, position_correction_.head(n) - velocity_correction_.head(n)));
    report.correction = convergence.last();
    const double acceleration = beta_ * h * h * weighted_rms_norm(system_, A1_);
    if (convergence.converged(acceleration, h * weighted_rms_norm(system_, to_.v),
                              weighted_rms_norm(system_, to_.q), 1e-13 * acceleration) ||
        (convergence.stalled() && convergence.last() <= kRoundoffErrors * correction_roundoff(h))) {
      report.converged = true;
      // Many iterations: the factorization is out of date, the next step makes a new one.
      if (i > 3) factored_step_ = 0;
      return report;
    }
    if (convergence.diverging()) return report;
  }
  return report;
}

}  // namespace trammel::solver::large_motion
