#include "solver/statics/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/assembly/strain.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/refinement.h"
#include "solver/model/numbers.h"
#include "solver/statics/linear_solution.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Digits that a relative error leaves, no more than a double has.
double digits(double error) {
  return -std::log10(std::clamp(error, kEps, 1.0));
}

/// q and its digits, or the outcome that keeps them from being.
void solve_linear(const System& system, StaticSolution& solution) {
  const LinearSolution linear = solve_linear_statics(system, solution.counters);
  solution.outcome = linear.outcome;
  if (!linear.outcome.solved()) return;
  solution.q = linear.q;
  solution.estimated_correct_digits = digits(linear.error);
}

/// Goes on from the linear solution: K + K_G of the latest forces, until they repeat.
Prestress solve_second_order(const System& system, StaticSolution& solution) {
  constexpr int kSteps = 50;
  const BodyForces weights = body_forces(system);
  ElasticState state;
  state.u = system.T * solution.q;
  Prestress latest = prestress(system, state.u, constraint_forces(system, state), weights);
  Factorization factorization;
  const Operator elastic = stiffness_operator(system);
  double last_change = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kSteps; ++step) {
    const SparseMatrix K_G = geometric_stiffness(system, latest);
    solution.counters.count(Effect::geometric_stiffening,
                            static_cast<std::int64_t>(system.mesh.frame.size()) +
                                static_cast<std::int64_t>(system.model.triangles.size()));
    factorization.compute(system.K + K_G);
    ++solution.counters.factorizations;
    if (!factorization.exists() || factorization.smallest_pivot() <= 0) {
      solution.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
      return latest;
    }
    const Operator tangent = [&](const VectorXd& q) -> VectorXd { return elastic(q) + K_G * q; };
    const VectorXd q =
        refined_solve(tangent, factorization, system.f, solution.q, solution.counters).x;
    const double change = (q - solution.q).norm();
    solution.q = q;
    state.u = system.T * q;
    state.prestress = &latest;
    const Prestress next = prestress(system, state.u, constraint_forces(system, state), weights);
    const bool rounding = change <= 1e-8 * q.norm() && change >= 0.5 * last_change;
    if (change <= 1e-13 * q.norm() || rounding) return latest;
    last_change = change;
    latest = next;
  }
  solution.outcome = {Status::not_converged,
                      "the forces of second-order theory do not settle; the loads may be close to "
                      "the buckling load"};
  return latest;
}

}  // namespace

StaticSolution solve_statics(const System& system, const StaticsOptions& options) {
  StaticSolution solution;
  solution.counters = system.counters;
  solution.q.setZero(system.K.rows());
  solution.estimated_correct_digits = digits(0);
  if (solution.q.size() > 0) solve_linear(system, solution);
  ElasticState state;
  Prestress forces;
  if (options.second_order && solution.outcome.solved() && solution.q.size() > 0) {
    forces = solve_second_order(system, solution);
    state.prestress = &forces;
  }
  if (!solution.outcome.solved()) {
    solution.q.resize(0);
    return solution;
  }
  state.u = system.T * solution.q;
  postprocess(system, state, solution);
  return solution;
}

}  // namespace trammel::solver
