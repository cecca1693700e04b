#include "solver/statics/statics.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/row_balance.h"
#include "solver/assembly/strain.h"
#include "solver/model/numbers.h"
#include "solver/statics/linear_solution.h"
#include "solver/statics/postprocessing.h"
#include "solver/statics/second_order.h"
#include "solver/statics/unbalanced_forces.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Digits that a relative error leaves, no more than a double has.
double digits(double error) {
  return -std::log10(std::clamp(error, kEps, 1.0));
}

/// What second-order theory adds to the first is d = -(K + K_G)^-1 K_G q: the stiffness K of that
/// motion over what the forces leave of it, d^T K d / d^T (K + K_G) d. Of one buckling shape it is
/// 1 / (1 - share of its load), whatever else the loads move.
double amplification(const System& system, const VectorXd& first, const StaticState& second) {
  const VectorXd added = second.q - first;
  const double stiffness = strain_products(system, system.T * added)(0, 0);
  const double roundoff = second.error * second.error;
  if (stiffness <= roundoff * strain_products(system, system.T * first)(0, 0)) return 1;
  const double left = -added.dot(geometric_stiffness(system, second.forces) * first);
  return stiffness > 0 && left > 0 ? stiffness / left : 1;
}

/// The claimed state's equation with K and K_G formed afresh, and the equilibrium of its forces.
void take_residuals(const System& system, const ElasticState& state, StaticSolution& solution) {
  RowBalance<double> rows(system);
  rows.add_stiffness(state.u);
  rows.add_load(-system.load);
  if (state.prestress) {
    rows.add(geometric_stiffness(system, *state.prestress), solution.q);
    // The forces of the state are differences of larger ones.
    const Prestress roundoff = prestress_roundoff(system, solution.q);
    rows.add_terms(geometric_stiffness_forces(system, roundoff, state.u).cwiseAbs() / kEps);
  }
  solution.evidence.add(Residual::equilibrium, rows.backward_error());
  solution.evidence.add(Residual::load, rows.residual_over_load());
  solution.evidence.add(Residual::recovered_forces,
                        unbalanced_forces(system, state, solution, rows.terms()));
}

}  // namespace

StaticSolution solve_statics(const System& system, const StaticsOptions& options) {
  StaticSolution solution;
  solution.counters = system.counters;
  StaticState reached{{}, VectorXd::Zero(system.K.rows()), {}, 0};
  if (reached.q.size() > 0) reached = solve_linear_statics(system, solution.counters);
  ElasticState state;
  if (options.second_order && reached.outcome.solved() && reached.q.size() > 0) {
    const VectorXd linear = reached.q;
    reached = solve_second_order(system, linear, solution.counters);
    if (reached.outcome.solved()) solution.amplification = amplification(system, linear, reached);
    solution.forces = reached.forces;
    state.prestress = &solution.forces;
  }
  solution.outcome = reached.outcome;
  if (!solution.outcome.solved()) return solution;
  solution.q = reached.q;
  solution.estimated_correct_digits = digits(reached.error);
  state.u = system.T * solution.q;
  state.constraint_forces = constraint_forces(system, state);
  postprocess(system, state, solution);
  take_residuals(system, state, solution);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
  return solution;
}

}  // namespace trammel::solver
