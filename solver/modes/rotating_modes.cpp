#include "solver/modes/rotating_modes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/assembly/equation_rows.h"
#include "solver/assembly/length_scales.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/gyroscopic.h"
#include "solver/linalg/refinement.h"
#include "solver/statics/describe_mechanism.h"
#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// The steady state and K + K_G - W^2 S in it.
class SteadyState {
 public:
  SteadyState(const System& system, const RotatingOptions& options, Counters& counters)
      : system_(system),
        frame_(options.frame),
        prestress_at_steady_state_(options.prestress_at_steady_state),
        geometric_stiffening_(options.stiffening),
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
    if (!geometric_stiffening_) return solve(added_, rhs);
    if (!prestress_at_steady_state_) {
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

  /// x^T (K + K_G - W^2 S) x, the elastic part from the elements' deformations.
  [[nodiscard]] double energy(const VectorXd& x) const {
    return strain_products(system_, system_.T * x)(0, 0) + x.dot(added_ * x);
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
    const VectorXd u = system_.T * q;
    VectorXd force =
        internal_forces(system_, u) - system_.load - centrifugal_forces(system_, frame_, shape);
    if (geometric_.axial.size() > 0) force += geometric_stiffness_forces(system_, geometric_, u);
    counters_.count(Effect::geometric_stiffening, 1);
    geometric_ = prestress(system_, u, system_.constraints.multipliers(force),
                           body_forces(system_, frame_, shape));
    added_ = softening_ + geometric_stiffness(system_, geometric_);
  }

  const System& system_;
  RotatingFrame frame_;
  bool prestress_at_steady_state_, geometric_stiffening_;
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
  EquationRows rows(system);
  rows.add_stiffness(system.T * steady.q);
  rows.add(steady.added(), steady.q);
  rows.add_load(system.load, -1);
  rows.add_load(centrifugal_forces(system, frame, VectorXd::Zero(system.T.rows())), -1);
  return rows.backward_error();
}

/// (K + K_G - W^2 S + s 2 W G + s^2 M) x = 0, s = growth rate + i w.
double mode_backward_error(const System& system, const SteadyState& steady, const SparseMatrix& C,
                           const Eigen::VectorXcd& x, std::complex<double> s) {
  const Eigen::VectorXcd u = system.T * x;
  EquationRows rows(system);
  rows.add_stiffness(u);
  rows.add_inertia(u, s * s);
  rows.add(steady.added(), x);
  rows.add(C, x, s);
  return rows.backward_error();
}

/// Modes missed or too many: of a stable state those below the last clear gap, of an unstable one
/// all, as many as the mass matrix has ranks.
double miscounted_modes(const GyroscopicPencil& pencil, const GyroscopicModes& modes, bool stable) {
  const VectorXd& w = modes.omega;
  if (!stable) {
    const double last = w.cwiseAbs2().maxCoeff() + modes.growth_rate.cwiseAbs2().maxCoeff();
    Factorization beyond;
    beyond.compute(shifted(pencil.K, pencil.M, 1e4 * last));
    return beyond.is_reliable() ? std::abs(static_cast<double>(beyond.negative_pivots() - w.size()))
                                : kNaN;
  }
  for (Index below = w.size() - 1; below >= 0; --below) {
    const double low = below > 0 ? w[below - 1] : 0;
    if (!(w[below] - low > 1e-6 * w[below])) continue;
    const Index counted = gyroscopic_sturm_count(pencil, (low + w[below]) / 2);
    return counted < 0 ? kNaN : std::abs(static_cast<double>(counted - below));
  }
  return w.size() == 0 ? 0 : kNaN;
}

Outcome require_held(const System& system, Counters& counters) {
  Factorization K;
  K.compute(system.K);
  ++counters.factorizations;
  const ZeroEnergyModes free = find_zero_energy_modes(system, K, counters);
  if (free.count() > 0) return {Status::singular, describe_mechanism(system, free)};
  return {};
}

GyroscopicModes gyroscopic_modes(const GyroscopicPencil& pencil, const SteadyState& steady,
                                 const RotatingOptions& options, Counters& counters) {
  constexpr Index kLargestUnstable = 400;
  if (steady.factorization.smallest_pivot() > 0) {
    return stable_gyroscopic_modes(pencil, steady.factorization, options.count, options.method,
                                   counters);
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
  result.outcome = require_held(system, result.counters);
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
                                [&steady](const VectorXd& x) { return steady.energy(x); }};
  if (system.M.coeffs().isZero(0)) return result;  // nothing swings
  const GyroscopicModes modes = gyroscopic_modes(pencil, steady, options, result.counters);
  result.outcome = modes.outcome;
  result.inertia_count = modes.inertia_count;
  const Index kept = std::min(options.count, modes.omega.size());
  result.frequency = modes.omega.head(kept) / (2 * std::numbers::pi);
  result.growth_rate = modes.growth_rate.head(kept);
  result.shape = modes.shape.leftCols(kept);
  result.stable = modes.growth_rate.size() == 0 || modes.growth_rate.maxCoeff() <= 0;
  if (!result.outcome.solved()) return result;
  for (Index j = 0; j < kept; ++j) {
    result.evidence.add(Residual::eigenvalue_equation,
                        mode_backward_error(system, steady, C, result.shape.col(j),
                                            {modes.growth_rate[j], modes.omega[j]}));
  }
  const bool definite = steady.factorization.smallest_pivot() > 0;
  result.evidence.add(Residual::mode_count, miscounted_modes(pencil, modes, definite));
  result.outcome = outcome_by_evidence(result.outcome, result.evidence);
  return result;
}

}  // namespace trammel::solver
