#include "solver/modes/prestressed_modes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "solver/assembly/prestress.h"
#include "solver/assembly/strain.h"
#include "solver/model/numbers.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The modes of (K + K_G) x = w^2 M x, K_G of the forces of a stable state.
/// @param roundoff  of these
ModalSolution solve_modes_with(const System& system, const Prestress& state,
                               const Prestress& roundoff, const ModesOptions& options) {
  const SparseMatrix K_G =
      system.K.rows() == 0 ? SparseMatrix(0, 0) : geometric_stiffness(system, state);
  ModalSolution solution;
  solution.counters = system.counters;
  if (system.K.rows() == 0) {
    judge_modes(system, &K_G, solution);
    return solution;
  }
  const SparseMatrix K = system.K + K_G;
  Factorization factorization;
  factorization.compute(shifted(K, system.M, 0));
  ++solution.counters.factorizations;
  if (!factorization.exists() || factorization.smallest_pivot() <= 0) {
    solution.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
    return solution;
  }
  const Operator elastic = stiffness_operator(system);
  Pencil pencil;
  pencil.K = &K;
  pencil.B = &system.M;
  pencil.K_times = [&](const VectorXd& x) -> VectorXd { return elastic(x) + K_G * x; };
  pencil.K_products = [&](const MatrixXd& X) -> MatrixXd {
    return strain_products(system, system.T * X) + X.transpose() * (K_G * X);
  };
  const MatrixXd no_null(K.rows(), 0);
  const Eigenpairs pairs = lowest_eigenpairs(pencil, no_null, options.count, options.method,
                                             factorization, solution.counters);
  solution.outcome = pairs.outcome;
  solution.inertia_count = pairs.inertia_count;
  solution.frequency = pairs.value.cwiseSqrt() / (2 * std::numbers::pi);
  solution.shape = pairs.vector;
  solution.roundoff.resize(pairs.value.size());
  for (Index j = 0; j < pairs.value.size(); ++j) {
    const VectorXd x = pairs.vector.col(j);
    const double rounding =
        strain_roundoff(system, system.T * x) + geometric_energy_roundoff(system, K_G, roundoff, x);
    solution.roundoff[j] = 0.5 * (rounding / pairs.value[j] + pairs.error[j]) + 4 * kEps;
  }
  judge_modes(system, &K_G, solution, std::move(factorization), pairs.check_shift);
  return solution;
}

}  // namespace

PrestressedModes solve_prestressed_modes(const System& system, const ModesOptions& options) {
  PrestressedModes result;
  result.state = solve_statics(system, {.second_order = true});
  if (!result.state.outcome.solved()) {
    result.modes.outcome = result.state.outcome;
    result.modes.counters = result.state.counters;
    return result;
  }
  result.modes = solve_modes_with(system, result.state.forces,
                                  prestress_roundoff(system, result.state.q), options);
  const auto solved = result.modes.counters;
  result.modes.evidence.add(result.state.evidence);
  result.modes.counters = result.state.counters;
  result.modes.counters.factorizations += solved.factorizations;
  result.modes.counters.solves += solved.solves;
  return result;
}

}  // namespace trammel::solver
