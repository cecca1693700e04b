#include "solver/large_motion/solve/motion_residuals.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "solver/linalg/backward_error.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

MotionResiduals::MotionResiduals(const ConstrainedSystem& system)
    : system_(system),
      row_unit_(system.row_unit()),
      matrix_(system.coordinates(), system.constraints(), system.blocks()),
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

double MotionResiduals::equation_of_motion(const State& state, const VectorXd& residual) {
  const Index n = system_.coordinates();
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
  return largest_ratio(residual, terms_.head(n));
}

ConstraintGaps MotionResiduals::constraints(const State& state) {
  system_.constraint_residual(state, constraint_residual_, constraint_rate_);
  ConstraintGaps gaps;
  for (Index r = 0; r < constraint_residual_.size(); ++r) {
    if (system_.compliance()[r] > 0) continue;
    const double position = std::abs(constraint_residual_[r]), rate = std::abs(constraint_rate_[r]);
    gaps.position = nan_max(gaps.position, position);
    gaps.rate = nan_max(gaps.rate, rate);
    gaps.relative_position = nan_max(gaps.relative_position, position / row_unit_[r]);
    gaps.relative_rate = nan_max(gaps.relative_rate, rate / row_unit_[r]);
  }
  return gaps;
}

AssemblyBranch::AssemblyBranch(const ConstrainedSystem& system) : system_(system) {
  constexpr Index kLargest = 64;  // the determinant is dense
  const Index n = system.coordinates();
  const Index rigid = (system.compliance().array() == 0).count();
  freedom_ = n - rigid;
  const bool is_mechanism = rigid == system.constraints() && (freedom_ == 0 || freedom_ == 1);
  if (n > 0 && n <= kLargest && is_mechanism) matrix_.emplace(n, rigid, system.blocks());
}

bool AssemblyBranch::changes(const State& from, const State& to) {
  if (!matrix_) return false;
  if (last_time_ != from.t) last_sign_ = orientation(from);
  last_time_ = from.t;
  const double sign = orientation(to);
  const VectorXd weight = system_.scale().cwiseAbs2().cwiseInverse();
  const bool reverses = freedom_ == 1 && from.v.cwiseProduct(weight).dot(to.v) < 0;
  if (last_sign_ * sign * (reverses ? -1 : 1) < 0) return true;
  last_time_ = to.t;
  last_sign_ = sign;
  return false;
}

double AssemblyBranch::orientation(const State& state) {
  const Index n = system_.coordinates();
  TangentCoefficients coefficients;
  coefficients.has_penalty = false;
  matrix_->clear();
  system_.tangent(state, coefficients, *matrix_);
  Eigen::MatrixXd G(n, n);
  G.topRows(n - freedom_) = matrix_->constraint_gradient(system_.scale(), system_.row_unit());
  if (freedom_ == 1) {
    const VectorXd rate = state.v.cwiseQuotient(system_.scale());
    const double speed = rate.norm();
    // A drive moves the mechanism as well: then its velocity has no orientation.
    if (speed == 0 || (G.topRows(n - 1) * rate).norm() > 1e-6 * speed) return 0;
    G.bottomRows<1>() = rate.normalized().transpose();
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(G);
  return lu.matrixLU().diagonal().array().sign().prod() *
         static_cast<double>(lu.permutationP().determinant());
}

}  // namespace trammel::solver::large_motion
