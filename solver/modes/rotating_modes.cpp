#include "solver/modes/rotating_modes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/assembly/length_scales.h"
#include "solver/assembly/row_balance.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/gyroscopic.h"
#include "solver/linalg/refinement.h"
#include "solver/statics/describe_mechanism.h"
#include "solver/statics/second_order.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// The steady state and K + K_G - W^2 S in it.
class SteadyState {
 public:
  SteadyState(const System& system, const RotatingOptions& options, Counters& counters)
      : system_(system),
        options_(options),
        frame_(options.frame),
        counters_(counters),
        softening_(-frame_.speed * frame_.speed * centrifugal_softening(system, frame_.axis)),
        elastic_(stiffness_operator(system)),
        q(VectorXd::Zero(system.K.rows())) {}

  /// False where the forces do not settle or the state does not exist.
  bool run() {
    constexpr int kSteps = 50;
    const VectorXd rhs =
        system_.f + system_.T.transpose() *
                        centrifugal_forces(system_, frame_, VectorXd::Zero(system_.T.rows()));
    added_ = softening_;
    if (!options_.stiffening) return solve(added_, rhs);
    if (!options_.prestress_at_steady_state) {
      if (!solve(SparseMatrix(system_.K.rows(), system_.K.rows()), rhs)) return false;
      update(VectorXd::Zero(system_.T.rows()));
      return solve(added_, rhs);
    }
    const SparseMatrix lengths = free_length_scales(system_);
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kSteps; ++step) {
      const VectorXd before = q;
      if (!solve(added_, rhs)) return false;
      const double change = (lengths * (q - before)).norm(), size = (lengths * q).norm();
      const bool settled =
          change <= 1e-13 * size || (change <= 1e-8 * size && change >= 0.5 * last);
      if (settled && step > 0) return true;
      last = change;
      update(system_.T * q);
    }
    return false;
  }

  /// K + K_G - W^2 S.
  [[nodiscard]] SparseMatrix tangent() const { return system_.K + added_; }

  /// K_G - W^2 S.
  [[nodiscard]] const SparseMatrix& added() const { return added_; }

  /// (K + K_G - W^2 S) x and X^T (K + K_G - W^2 S) X, the elastic part from the elements'
  /// deformations.
  [[nodiscard]] VectorXd times(const VectorXd& x) const { return elastic_(x) + added_ * x; }
  [[nodiscard]] MatrixXd products(const MatrixXd& X) const {
    return strain_products(system_, system_.T * X) + X.transpose() * (added_ * X);
  }

 private:
  /// (K + added) q = right.
  bool solve(const SparseMatrix& added, const VectorXd& rhs) {
    factorization.compute(shifted(system_.K, added, -1));
    ++counters_.factorizations;
    if (!factorization.exists()) return false;
    const Operator A = [&](const VectorXd& x) -> VectorXd { return elastic_(x) + added * x; };
    const RefinedSolution refined = refined_solve(A, factorization, rhs, counters_);
    q = refined.x;
    return refined.converged();
  }

  /// K_G of the forces in the state q, which the centrifugal forces of a shape u hold.
  void update(const VectorXd& shape) {
    const Prestress* const before = geometric_.axial.size() > 0 ? &geometric_ : nullptr;
    counters_.count(Effect::geometric_stiffening, 1);
    geometric_ =
        forces_of(system_, system_.T * q, system_.load + centrifugal_forces(system_, frame_, shape),
                  body_forces(system_, frame_, shape), before);
    added_ = softening_ + geometric_stiffness(system_, geometric_);
  }

  const System& system_;
  const RotatingOptions& options_;
  const RotatingFrame& frame_;
  Counters& counters_;
  SparseMatrix softening_;
  SparseMatrix added_;
  Operator elastic_;
  Prestress geometric_;

 public:
  VectorXd q;
  Factorization factorization;
};

/// Equilibrium of the steady state: (K + K_G - W^2 S) q = f + W^2 f_c.
double steady_backward_error(const System& system, const SteadyState& steady,
                             const RotatingFrame& frame) {
  RowBalance<double> rows(system);
  rows.add_stiffness(system.T * steady.q);
  rows.add(steady.added(), steady.q);
  rows.add_load(-system.load);
  rows.add_load(-centrifugal_forces(system, frame, VectorXd::Zero(system.T.rows())));
  return rows.backward_error();
}

/// (K + K_G - W^2 S + s 2 W G + s^2 M) x = 0, s = growth rate + i w, of all modes.
double mode_backward_error(const System& system, const SteadyState& steady, const SparseMatrix& C,
                           const MatrixXcd& x, const VectorXcd& s) {
  const MatrixXcd u = system.T * x;
  RowBalance<std::complex<double>> rows(system, x.cols());
  rows.add_stiffness(u);
  rows.add_inertia(u * s.cwiseProduct(s).asDiagonal());
  rows.add(steady.added(), x);
  rows.add(C, x * s.asDiagonal());
  return rows.backward_error();
}

/// Modes missed or too many: of a stable state those below the last clear gap, of an unstable one
/// all, as many as the rank of the mass matrix.
double miscounted_modes(const GyroscopicPencil& pencil, const GyroscopicModes& modes, bool stable) {
  const VectorXd& w = modes.omega;
  if (stable) {
    return miscounted_eigenvalues(
        w, [&pencil](double omega) { return gyroscopic_sturm_count(pencil, omega); });
  }
  const double last = w.cwiseAbs2().maxCoeff() + modes.growth_rate.cwiseAbs2().maxCoeff();
  const auto counted = Factorization().inertia(shifted(pencil.K, pencil.M, 1e4 * last));
  return counted ? std::abs(static_cast<double>(*counted - w.size())) : kNaN;
}

GyroscopicModes gyroscopic_modes(const GyroscopicPencil& pencil, const SteadyState& steady,
                                 const RotatingOptions& options, Counters& counters) {
  constexpr Index kLargestUnstable = 400;
  if (steady.factorization.smallest_pivot() > 0) {
    return stable_gyroscopic_modes(pencil, options.count, options.method, counters);
  }
  if (pencil.K.rows() <= kLargestUnstable) return all_gyroscopic_modes(pencil);
  GyroscopicModes modes;
  modes.outcome = {Status::not_converged,
                   "the stiffness of the rotating frame is not positive definite, and the model "
                   "is too large for the dense solution that this needs"};
  return modes;
}

}  // namespace

RotatingModes solve_rotating_modes(const System& system, const RotatingOptions& options) {
  RotatingModes result;
  result.counters = system.counters;
  if (system.K.rows() == 0) return result;
  Factorization K;
  K.compute(system.K);
  ++result.counters.factorizations;
  result.outcome = require_held(system, K, result.counters);
  if (result.outcome.solved() && options.stiffening)
    result.outcome = require_determined_stiffening(system);
  if (!result.outcome.solved()) return result;
  SteadyState steady(system, options, result.counters);
  if (!steady.run()) {
    result.outcome = {Status::not_converged, "the steady state of the rotating frame is not found"};
    return result;
  }
  result.q = steady.q;
  result.evidence.add(Residual::equilibrium, steady_backward_error(system, steady, options.frame));
  const bool has_gyroscopic_forces =
      options.gyroscopic && options.frame.axis == RotationAxis::normal;
  SparseMatrix C(system.K.rows(), system.K.cols());
  if (has_gyroscopic_forces) {
    C = 2 * options.frame.speed * gyroscopic_matrix(system);
    result.counters.count(Effect::gyroscopic, 1);
  }
  const GyroscopicPencil pencil{steady.tangent(), C, system.M,
                                [&steady](const VectorXd& x) { return steady.times(x); },
                                [&steady](const MatrixXd& X) { return steady.products(X); }};
  if (system.M.coeffs().isZero(0)) return result;  // nothing swings
  const GyroscopicModes modes = gyroscopic_modes(pencil, steady, options, result.counters);
  result.outcome = modes.outcome;
  const Index kept = std::min(options.count, modes.omega.size());
  result.frequency = modes.omega.head(kept) / (2 * std::numbers::pi);
  result.growth_rate = modes.growth_rate.head(kept);
  result.shape = modes.shape.leftCols(kept);
  result.stable = modes.growth_rate.size() == 0 || modes.growth_rate.maxCoeff() <= 0;
  if (!result.outcome.solved()) return result;
  if (kept > 0) {
    VectorXcd exponent(kept);
    exponent.real() = modes.growth_rate.head(kept);
    exponent.imag() = modes.omega.head(kept);
    result.evidence.add(Residual::eigenvalue_equation,
                        mode_backward_error(system, steady, C, result.shape, exponent));
  }
  const bool definite = steady.factorization.smallest_pivot() > 0;
  result.evidence.add(Residual::mode_count, miscounted_modes(pencil, modes, definite));
  result.outcome = outcome_by_evidence(result.outcome, result.evidence);
  return result;
}

}  // namespace trammel::solver
