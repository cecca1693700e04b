#include "solver/linear/second_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solver/linalg/factorization.h"
#include "solver/linalg/forward_error.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/free_motions.h"
#include "solver/linear/system.h"

namespace trammel::solver {

using Eigen::VectorXd;

StaticState solve_linear_statics(const System& system, Counters& counters) {
  StaticState solution;
  Factorization factorization;
  factorization.compute(system.K);
  ++counters.factorizations;
  solution.outcome = require_no_mechanism(system, factorization, counters);
  if (!solution.outcome.solved()) return solution;
  const FactoredStiffness factors = factor_stiffness(system);
  const SparseMatrix R = free_to_length_matrix(system);
  const auto take = [&](const VectorXd& q, double left, const Operator& inverse) {
    solution.q = q;
    const double bound = forward_error(factors, R, q, system.f, inverse);
    solution.error = bound + left;
    // The comparison is false for NaN.
    return left <= bound;
  };
  const auto solve = [&](const VectorXd& b) -> VectorXd {
    ++counters.solves;
    return factorization.solve(b);
  };
  const auto by_stiffness = [&] {
    if (!factorization.is_nonsingular() || factorization.smallest_pivot() <= 0) return false;
    const Operator K = stiffness_operator(system);
    const RefinedSolution first = refined_solve(K, factorization, system.f, counters);
    const VectorXd left = solve(system.f - K(first.x));
    return take(first.x, left.norm() == 0 ? 0 : left.norm() / first.x.norm(), solve);
  };
  if (!by_stiffness()) {
    const AugmentedSystem augmented(factors);
    ++counters.factorizations;
    if (augmented.is_nonsingular()) {
      const RefinedSolution found = augmented.solve(system.f);
      take(found.x, found.correction,
           [&](const VectorXd& b) -> VectorXd { return augmented.solve(b).x; });
    }
  }
  solution.outcome = outcome_by_displacement_error(solution.error);
  return solution;
}

Outcome outcome_by_displacement_error(double error) {
  if (error < 0.1) return {};
  return {Status::not_converged,
          "the model is too ill-conditioned for double precision: less than one digit of the "
          "displacements would be correct"};
}

double relative_force_roundoff(const System& system, const VectorXd& q) {
  const VectorXd length = length_scales(system), u = system.T * q;
  double largest = 0, lost = 0;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto local = detail::gather(coordinates, u);
    const auto force = (B.transpose() * c.cwiseProduct(B * local)).eval();
    const auto rounding = detail::force_roundoff(B, c, local);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (coordinates[i] < 0) continue;
      const auto k = static_cast<Index>(i);
      largest = std::max(largest, std::abs(force[k]) / length[coordinates[i]]);
      lost = std::max(lost, rounding[k] / length[coordinates[i]]);
    }
  });
  return largest > 0 ? lost / largest : 0;
}

namespace {

// Smallest load step, as a fraction of the full load.
constexpr double kSmallestStep = 1e-4;

/// Returns the internal forces of a state q under the fraction `load` of the full load.
Prestress forces_at(const System& system, double load, const VectorXd& q, const Prestress* before) {
  BodyForces weights = body_forces(system);
  for (Vector2d& weight : weights.element) weight *= load;
  for (Vector2d& weight : weights.point_mass) weight *= load;
  return prestress_of(system, system.T * q, load * system.load, weights, before);
}

}  // namespace

StiffenedEquilibrium::StiffenedEquilibrium(const System& system, Counters& counters,
                                           const SparseMatrix* softening)
    : system_(system),
      counters_(counters),
      softening_(softening),
      lengths_(free_to_length_matrix(system)),
      elastic_(stiffness_operator(system)) {}

void StiffenedEquilibrium::iterate(const VectorXd& f, const Forces& forces, StaticState& state) {
  constexpr int kIterations = 60;
  double last_change = std::numeric_limits<double>::infinity();
  int growing = 0;
  for (int k = 0; k < kIterations && growing < 4; ++k) {
    const VectorXd before = state.q;
    if (!solve(f, state)) return;
    state.forces = forces(state.q, &state.forces);
    const double size = largest_displacement(state.q);
    const double change = largest_displacement(state.q - before);
    const double ratio = change / last_change;
    const bool slow = !(ratio < 0.5);
    left_ = size > 0 ? change / size * (ratio < 1 ? ratio / (1 - ratio) : 1) : 0;
    // Internal forces can change even if no coordinate moves. Convergence therefore requires at
    // least two iterations.
    const bool settled = change <= 1e-14 * size ||
                         (slow && change <= displacement_roundoff_of_forces(state) + 1e-8 * size);
    if (k > 0 && settled) return;
    growing = change < last_change ? 0 : growing + 1;
    last_change = change;
  }
  state.outcome = {Status::not_converged, "the iteration for the internal forces did not converge"};
}

bool StiffenedEquilibrium::solve(const VectorXd& f, StaticState& state) {
  added_ = geometric_stiffness(system_, state.forces);
  const auto elements = std::ssize(system_.mesh.frame) + std::ssize(system_.model.triangles);
  if (added_.nonZeros() > 0) counters_.add(Effect::geometric_stiffening, elements);
  if (softening_) added_ += *softening_;
  factorization_.compute(system_.K + added_);
  ++counters_.factorizations;
  if (!factorization_.is_nonsingular() || (!softening_ && factorization_.smallest_pivot() <= 0)) {
    state.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
    return false;
  }
  const Operator tangent = [this](const VectorXd& q) { return restoring_forces(q); };
  const RefinedSolution refined = refined_solve(tangent, factorization_, f, counters_);
  state.q = refined.x;
  if (refined.converged()) return true;
  state.outcome = {Status::not_converged, "stiffness too ill-conditioned for double precision"};
  return false;
}

VectorXd StiffenedEquilibrium::restoring_forces(const VectorXd& q) const {
  return elastic_(q) + added_ * q;
}

double StiffenedEquilibrium::relative_displacement_error(const StaticState& state) const {
  const Operator inverse = [this](const VectorXd& b) -> VectorXd {
    ++counters_.solves;
    return factorization_.solve(b);
  };
  if (state.q.isZero(0)) return 0;
  return forward_error(factor_stiffness(system_), lengths_, state.q, system_.f, inverse) +
         displacement_roundoff_of_forces(state) / largest_displacement(state.q) + left_;
}

double StiffenedEquilibrium::largest_displacement(const VectorXd& q) const {
  return (lengths_ * q).lpNorm<Eigen::Infinity>();
}

double StiffenedEquilibrium::displacement_roundoff_of_forces(const StaticState& state) const {
  const VectorXd change = geometric_stiffness_forces(system_, prestress_roundoff(system_, state.q),
                                                     system_.T * state.q);
  ++counters_.solves;
  return largest_displacement(factorization_.solve(system_.T.transpose() * change));
}

Prestress prestress_of(const System& system, const VectorXd& u, const VectorXd& load,
                       const BodyForces& body, const Prestress* stiffening) {
  VectorXd force = internal_forces(system, u) - load;
  if (stiffening) force += geometric_stiffness_forces(system, *stiffening, u);
  return prestress(system, u, system.constraints.lagrange_multipliers(force), body);
}

StaticState solve_second_order(const System& system, const VectorXd& linear, Counters& counters) {
  StaticState reached;
  reached.outcome = require_determinate_prestress(system);
  if (!reached.outcome.solved()) return reached;
  StiffenedEquilibrium equilibrium(system, counters);
  // Outcome of the first attempt, with the full load in one step.
  Outcome whole;
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
           << " times the loads";
    return {{whole.status, reason.str()}, {}, {}};
  }
  reached.error = equilibrium.relative_displacement_error(reached);
  reached.outcome = outcome_by_displacement_error(reached.error);
  return reached;
}

}  // namespace trammel::solver
