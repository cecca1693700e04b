#include "solver/large_motion/solve/motion_residuals.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/backward_error.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

MotionResiduals::MotionResiduals(const ConstrainedSystem& system, const Stepper& stepper)
    : system_(system),
      stepper_(stepper),
      row_unit_(system.row_unit()),
      matrix_(system.coordinates(), system.constraints(), system.blocks()),
      residual_(VectorXd::Zero(system.coordinates())),
      unknowns_(VectorXd::Zero(system.coordinates() + system.constraints())),
      terms_(unknowns_),
      magnitudes_(unknowns_),
      constraint_residual_(VectorXd::Zero(system.constraints())),
      constraint_rate_(constraint_residual_) {}

void MotionResiduals::add_terms(const TangentCoefficients& coefficients, const State& state) {
  matrix_.clear();
  system_.tangent(state, coefficients, matrix_);
  matrix_.term_magnitudes(unknowns_, magnitudes_);
  terms_ += magnitudes_;
}

void MotionResiduals::add_equation_of_motion(Evidence& evidence) {
  const State& state = stepper_.state();
  const Index n = system_.coordinates();
  evidence.add(Residual::equation_of_motion, stepper_.relation_residual());
  stepper_.force_residual(residual_);
  terms_.setZero();
  unknowns_.head(n) = state.a;
  unknowns_.tail(state.lambda.size()).setZero();
  // Hardly any stiffness, and not none: rows of what has no mass would divide by it.
  add_terms({.mass = 1, .damping = 0, .stiffness = 1e-30, .compliance = 1}, state);
  unknowns_ << state.q, state.lambda;
  add_terms({}, state);
  const auto scale = system_.scale().array();
  const double least = n > 0 ? kLeastShare * (terms_.head(n).array() * scale).maxCoeff() : 0;
  terms_.head(n) = terms_.head(n).array().max(least / scale);
  evidence.add(Residual::equation_of_motion, largest_ratio(residual_, terms_.head(n)));
}

void MotionResiduals::add_constraints(double h, Evidence& evidence) {
  system_.constraint_residual(stepper_.state(), constraint_residual_, constraint_rate_);
  const double rate = stepper_.keeps_rates() ? h : 0;
  evidence.add(Residual::constraints, 0);  // every row may be compliant
  for (Index r = 0; r < constraint_residual_.size(); ++r) {
    if (system_.compliance()[r] > 0) continue;
    evidence.add(Residual::constraints, std::abs(constraint_residual_[r]) / row_unit_[r]);
    evidence.add(Residual::constraints, rate * std::abs(constraint_rate_[r]) / row_unit_[r]);
  }
}

void MotionResiduals::take_energy() {
  const auto step = stepper_.energy_step();
  if (!step) return;
  has_energy_ = true;
  energy_gap_ += step->after.total() - step->before.total() - step->work;
  throughput_ += std::abs(step->work);
  for (const Energy& e : {step->before, step->after})
    largest_energy_ = std::max(largest_energy_, e.kinetic + e.strain + std::abs(e.load));
  largest_energy_gap_ = nan_max(largest_energy_gap_, std::abs(energy_gap_));
}

void MotionResiduals::add_energy(Evidence& evidence) const {
  const double size = largest_energy_ + throughput_;
  if (has_energy_) evidence.add(Residual::energy, size > 0 ? largest_energy_gap_ / size : 0);
}

}  // namespace trammel::solver::large_motion
