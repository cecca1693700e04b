#include "solver/modes/rotating_modes.h"

#include <cmath>
#include <numbers>

#include "solver/assembly/row_balance.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/gyroscopic.h"
#include "solver/statics/describe_mechanism.h"
#include "solver/statics/second_order.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Solves for the steady state; returns false if the forces do not settle or it does not exist.
bool find_steady_state(const System& system, const RotatingOptions& options,
                       StiffenedEquilibrium& steady, StaticState& state, Counters& counters) {
  const RotatingFrame& frame = options.frame;
  const VectorXd undeformed = VectorXd::Zero(system.T.rows());
  const VectorXd rhs =
      system.f + system.T.transpose() * centrifugal_forces(system, frame, undeformed);
  // Forces in q, which the centrifugal forces of displacements u hold.
  const auto forces = [&](const VectorXd& q, const VectorXd& u, const Prestress* before) {
    return forces_of(system, system.T * q, system.load + centrifugal_forces(system, frame, u),
                     body_forces(system, frame, u), before);
  };
  if (options.stiffening && options.prestress_at_steady_state) {
    steady.iterate(
        rhs,
        [&](const VectorXd& q, const Prestress* before) { return forces(q, system.T * q, before); },
        state);
    return state.outcome.solved();
  }
  if (options.stiffening) {
    if (!StiffenedEquilibrium(system, counters).solve(rhs, state)) return false;
    state.forces = forces(state.q, undeformed, nullptr);
  }
  return steady.solve(rhs, state);
}

/// Equilibrium of the steady state: (K + K_G - W^2 S) q = f + W^2 f_c.
double steady_backward_error(const System& system, const SparseMatrix& added, const VectorXd& q,
                             const RotatingFrame& frame) {
  RowBalance<double> rows(system);
  rows.add_stiffness(system.T * q);
  rows.add(added, q);
  rows.add_load(-system.load);
  rows.add_load(-centrifugal_forces(system, frame, VectorXd::Zero(system.T.rows())));
  return rows.backward_error();
}

/// (K + K_G - W^2 S + s 2 W G + s^2 M) x = 0, s = growth rate + i w, of all modes.
double mode_backward_error(const System& system, const SparseMatrix& added, const SparseMatrix& C,
                           const MatrixXcd& x, const VectorXcd& s) {
  const MatrixXcd u = system.T * x;
  RowBalance<std::complex<double>> rows(system, x.cols());
  rows.add_stiffness(u);
  rows.add_inertia(u * s.cwiseProduct(s).asDiagonal());
  rows.add(added, x);
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

GyroscopicModes gyroscopic_modes(const GyroscopicPencil& pencil, bool stable,
                                 const RotatingOptions& options, Counters& counters) {
  constexpr Index kLargestUnstable = 400;
  if (stable) {
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
  const double speed = options.frame.speed;
  const SparseMatrix softening = -speed * speed * centrifugal_softening(system, options.frame.axis);
  StiffenedEquilibrium steady(system, result.counters, &softening);
  StaticState state{{}, VectorXd::Zero(system.K.rows()), {}, 0};
  if (!find_steady_state(system, options, steady, state, result.counters)) {
    result.outcome = {Status::not_converged, "the steady state of the rotating frame is not found"};
    return result;
  }
  result.q = state.q;
  const SparseMatrix& added = steady.added();
  result.evidence.add(Residual::equilibrium,
                      steady_backward_error(system, added, state.q, options.frame));
  const bool has_gyroscopic_forces =
      options.gyroscopic && options.frame.axis == RotationAxis::normal;
  SparseMatrix C(system.K.rows(), system.K.cols());
  if (has_gyroscopic_forces) {
    C = 2 * speed * gyroscopic_matrix(system);
    result.counters.count(Effect::gyroscopic, 1);
  }
  const GyroscopicPencil pencil{
      system.K + added, C, system.M, [&](const VectorXd& x) { return steady.times(x); },
      [&](const MatrixXd& X) -> MatrixXd {
        return strain_products(system, system.T * X) + X.transpose() * (added * X);
      }};
  if (system.M.coeffs().isZero(0)) return result;  // nothing swings
  const bool stable = steady.is_stable();
  const GyroscopicModes modes = gyroscopic_modes(pencil, stable, options, result.counters);
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
                        mode_backward_error(system, added, C, result.shape, exponent));
  }
  result.evidence.add(Residual::mode_count, miscounted_modes(pencil, modes, stable));
  result.outcome = outcome_by_evidence(result.outcome, result.evidence);
  return result;
}

}  // namespace trammel::solver
