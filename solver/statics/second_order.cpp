#include "solver/statics/second_order.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "solver/assembly/length_scales.h"
#include "solver/assembly/stiffness_factors.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/forward_error.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

constexpr double kSmallestStep = 1e-4;  // share of the loads

/// Forces that hold q under a share of the loads.
Prestress forces_at(const System& system, double load, const VectorXd& q, const Prestress* before) {
  BodyForces weights = body_forces(system);
  for (Vector2d& weight : weights.element) weight *= load;
  for (Vector2d& weight : weights.point_mass) weight *= load;
  return forces_of(system, system.T * q, load * system.load, weights, before);
}

}  // namespace

StiffenedEquilibrium::StiffenedEquilibrium(const System& system, Counters& counters,
                                           const SparseMatrix* softening)
    : system_(system),
      counters_(counters),
      softening_(softening),
      lengths_(free_length_scales(system)),
      elastic_(stiffness_operator(system)) {}

void StiffenedEquilibrium::iterate(const VectorXd& f, const Forces& forces, StaticState& state) {
  constexpr int kIterations = 60;
  double last_change = std::numeric_limits<double>::infinity();
  int growing = 0;
  for (int k = 0; k < kIterations && growing < 4; ++k) {
    const VectorXd before = state.q;
    if (!solve(f, state)) return;
    state.forces = forces(state.q, &state.forces);
    const double size = measure(state.q);
    const double change = measure(state.q - before);
    const double ratio = change / last_change;
    const bool slow = !(ratio < 0.5);
    left_ = size > 0 ? change / size * (ratio < 1 ? ratio / (1 - ratio) : 1) : 0;
    // Forces can change where nothing moves: they are those that were factored from the second on.
    const bool settled =
        change <= 1e-14 * size || (slow && change <= force_rounding(state) + 1e-8 * size);
    if (k > 0 && settled) return;
    growing = change < last_change ? 0 : growing + 1;
    last_change = change;
  }
  state.outcome = {Status::not_converged, "the forces of the state do not settle"};
}

bool StiffenedEquilibrium::solve(const VectorXd& f, StaticState& state) {
  added_ = geometric_stiffness(system_, state.forces);
  const auto elements = std::ssize(system_.mesh.frame) + std::ssize(system_.model.triangles);
  if (added_.nonZeros() > 0) counters_.count(Effect::geometric_stiffening, elements);
  if (softening_) added_ += *softening_;
  factorization_.compute(system_.K + added_);
  ++counters_.factorizations;
  if (!factorization_.exists() || (!softening_ && factorization_.smallest_pivot() <= 0)) {
    state.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
    return false;
  }
  const Operator tangent = [this](const VectorXd& q) { return times(q); };
  const RefinedSolution refined = refined_solve(tangent, factorization_, f, counters_);
  state.q = refined.x;
  if (refined.converged()) return true;
  state.outcome = {Status::not_converged, "the stiffness of the state is too ill-conditioned"};
  return false;
}

VectorXd StiffenedEquilibrium::times(const VectorXd& q) const {
  return elastic_(q) + added_ * q;
}

double StiffenedEquilibrium::error(const StaticState& state) const {
  const Operator inverse = [this](const VectorXd& b) -> VectorXd {
    ++counters_.solves;
    return factorization_.solve(b);
  };
  if (state.q.isZero(0)) return 0;
  return forward_error(stiffness_factors(system_), lengths_, state.q, system_.f, inverse) +
         force_rounding(state) / measure(state.q) + left_;
}

double StiffenedEquilibrium::measure(const VectorXd& q) const {
  return (lengths_ * q).lpNorm<Eigen::Infinity>();
}

double StiffenedEquilibrium::force_rounding(const StaticState& state) const {
  const VectorXd change = geometric_stiffness_forces(system_, prestress_roundoff(system_, state.q),
                                                     system_.T * state.q);
  ++counters_.solves;
  return measure(factorization_.solve(system_.T.transpose() * change));
}

Prestress forces_of(const System& system, const VectorXd& u, const VectorXd& load,
                    const BodyForces& body, const Prestress* before) {
  VectorXd force = internal_forces(system, u) - load;
  if (before) force += geometric_stiffness_forces(system, *before, u);
  return prestress(system, u, system.constraints.multipliers(force), body);
}

StaticState solve_second_order(const System& system, const VectorXd& linear, Counters& counters) {
  StaticState reached;
  reached.outcome = require_determined_stiffening(system);
  if (!reached.outcome.solved()) return reached;
  StiffenedEquilibrium equilibrium(system, counters);
  Outcome whole;  // of the first attempt, under the whole load
  double load = 0, step = 1;
  while (load < 1) {
    const double target = std::min(1.0, load + step);
    StaticState next = reached;
    if (load == 0) next.q = target * linear;
    if (load == 0) next.forces = forces_at(system, target, next.q, nullptr);
    equilibrium.iterate(
        target * system.f,
        [&](const VectorXd& q, const Prestress* before) {
          return forces_at(system, target, q, before);
        },
        next);
    if (next.outcome.solved()) {
      reached = std::move(next);
      load = target;
      step *= 2;
      continue;
    }
    if (load == 0 && step == 1) whole = next.outcome;
    step /= step >= 1 ? 8 : 2;
    if (step >= kSmallestStep) continue;
    std::ostringstream reason;
    reason.precision(4);
    reason << whole.reason << ": second-order theory has no stable equilibrium beyond " << load
           << " of the loads";
    return {{whole.status, reason.str()}, {}, {}};
  }
  reached.error = equilibrium.error(reached);
  reached.outcome = outcome_by_error(reached.error);
  return reached;
}

}  // namespace trammel::solver
