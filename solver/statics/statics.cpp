#include "solver/statics/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/assembly/equation_rows.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/refinement.h"
#include "solver/statics/postprocessing.h"
#include "solver/statics/second_order.h"
#include "solver/statics/unbalanced_forces.h"
#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// q and estimated_correct_digits of K q = f, or the outcome that keeps them from being.
void solve_linear(const System& system, StaticSolution& solution) {
  Factorization factorization;
  factorization.compute(system.K);
  ++solution.counters.factorizations;
  const ZeroEnergyModes free = find_zero_energy_modes(system, factorization, solution.counters);
  if (free.count() > 0) {
    solution.outcome = {Status::singular, describe_mechanism(system, free)};
    return;
  }
  const bool definite = factorization.exists() && factorization.smallest_pivot() > 0;
  const RefinedSolution refined =
      definite
          ? refined_solve(stiffness_operator(system), factorization, system.f, solution.counters)
          : RefinedSolution{solution.q, 1};
  if (!refined.converged()) {
    solution.outcome = {Status::not_converged,
                        "the stiffness matrix is too ill-conditioned for double precision"};
    return;
  }
  solution.q = refined.x;
  const double lost = factorization.condition() * std::numeric_limits<double>::epsilon();
  solution.estimated_correct_digits = std::max(0.0, -std::log10(lost));
}

/// The claimed state's equation with K and K_G formed afresh, and the equilibrium of its forces.
void take_residuals(const System& system, const ElasticState& state, StaticSolution& solution) {
  EquationRows rows(system);
  rows.add_stiffness(state.u);
  rows.add_load(system.load, -1);
  if (state.prestress) rows.add(geometric_stiffness(system, *state.prestress), solution.q);
  solution.evidence.add(Residual::equilibrium, rows.backward_error());
  solution.evidence.add(Residual::load, rows.residual_over(system.f));
  solution.evidence.add(Residual::recovered_forces,
                        unbalanced_forces(system, state, solution, rows.terms()));
}

}  // namespace

StaticSolution solve_statics(const System& system, const StaticsOptions& options) {
  StaticSolution solution;
  solution.counters = system.counters;
  solution.q.setZero(system.K.rows());
  solution.estimated_correct_digits = -std::log10(std::numeric_limits<double>::epsilon());
  if (solution.q.size() > 0) solve_linear(system, solution);
  SecondOrderState second;
  ElasticState state;
  if (options.second_order && solution.outcome.solved() && solution.q.size() > 0) {
    second = solve_second_order(system, solution.q, solution.counters);
    solution.outcome = second.outcome;
    solution.q = second.q;
    state.prestress = &second.forces;
  }
  if (!solution.outcome.solved()) {
    solution.q.resize(0);
    return solution;
  }
  state.u = system.T * solution.q;
  postprocess(system, state, solution);
  take_residuals(system, state, solution);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
  return solution;
}

}  // namespace trammel::solver
