#include "solver/statics/buckling.h"

#include <limits>
#include <utility>

#include "solver/assembly/equation_rows.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/eigenvalue_count.h"
#include "solver/linalg/refinement.h"
#include "solver/model/numbers.h"
#include "solver/statics/postprocessing.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

BucklingSolution solve_buckling(const System& system, const BucklingOptions& options) {
  BucklingSolution solution;
  const StaticSolution statics = solve_statics(system);
  solution.counters = statics.counters;
  solution.outcome = statics.outcome;
  solution.evidence = statics.evidence;
  if (!statics.outcome.solved() || statics.q.size() == 0) return solution;
  solution.outcome = require_determined_stiffening(system);
  if (!solution.outcome.solved()) return solution;
  ElasticState state;
  state.u = system.T * statics.q;
  const Prestress forces =
      prestress(system, state.u, constraint_forces(system, state), body_forces(system));
  const SparseMatrix softening = -geometric_stiffness(system, forces);
  if (softening.nonZeros() == 0 || softening.coeffs().isZero(0)) {
    solution.evidence.add(Residual::mode_count, 0);  // K + factor 0 stays what it is
    return solution;
  }
  Pencil pencil;
  pencil.K = &system.K;
  pencil.B = &softening;
  pencil.indefinite = true;
  pencil.K_times = stiffness_operator(system);
  pencil.K_products = [&system](const Eigen::MatrixXd& X) {
    return strain_products(system, system.T * X);
  };
  Factorization factorization;
  factorization.compute(shifted(system.K, softening, 0));
  ++solution.counters.factorizations;
  const Eigen::MatrixXd no_null(system.K.rows(), 0);
  const Eigenpairs pairs = lowest_eigenpairs(pencil, no_null, options.count, options.method,
                                             factorization, solution.counters);
  solution.outcome = pairs.outcome;
  solution.load_factor = pairs.value;
  solution.shape = pairs.vector;
  solution.inertia_count = pairs.inertia_count;
  solution.roundoff.resize(pairs.value.size());
  const Prestress roundoff = prestress_roundoff(system, statics.q);
  for (Index j = 0; j < pairs.value.size(); ++j) {
    const Eigen::VectorXd x = pairs.vector.col(j);
    const Eigen::VectorXd u = system.T * x;
    const double elastic = strain_roundoff(system, u) / pairs.value[j];
    const double geometric = geometric_energy_roundoff(system, softening, roundoff, x);
    solution.roundoff[j] = elastic + geometric + pairs.error[j] + 4 * kEps;
    EquationRows rows(system);
    rows.add_stiffness(u);
    rows.add(softening, x, -solution.load_factor[j]);
    solution.evidence.add(Residual::eigenvalue_equation, rows.backward_error());
  }
  if (!solution.outcome.solved()) return solution;
  const double missed = miscounted_eigenvalues(system.K, softening, solution.load_factor,
                                               std::move(factorization), pairs.check_shift);
  const auto twice = static_cast<double>(dependent_vectors(system.K, solution.shape));
  solution.evidence.add(Residual::mode_count, missed + twice);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
  return solution;
}

}  // namespace trammel::solver
