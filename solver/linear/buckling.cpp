#include "solver/linear/buckling.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/linalg/factorization.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/second_order.h"
#include "solver/linear/statics.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

/// Bracket of the lowest buckling factor from numbers of negative pivots. With B = -K_G, K - t B
/// has as many negative pivots as there are buckling factors between 0 and t (Sylvester's law of
/// inertia).
struct FirstFactor {
  /// false: the numbers of negative pivots are unreliable.
  bool determined = false;
  bool exists = false;  ///< false: there is no buckling factor up to `checked`
  /// Lower bound of the lowest buckling factor, at least a fifth of this factor.
  double below = 0;
  double checked = 0;  ///< largest t for which the negative pivots were counted
};

FirstFactor bracket_first_factor(const SparseMatrix& K, const SparseMatrix& B,
                                 Factorization& factorization, Counters& counters) {
  // Limit of the number of reductions of the load factor t by the factor 1/4, in total 120 orders
  // of magnitude.
  constexpr int kHalvings = 200;
  FirstFactor first;
  // `largest` and `least` are the extreme magnitudes of the entries of B = -K_G. The entries are
  // scaled with the factors that give K a unit diagonal. `least` excludes round-off errors of the
  // largest entry.
  constexpr double kRoundoff = 1e4 * kEps;
  const Eigen::VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  const SparseMatrix scaled = (scale.asDiagonal() * B * scale.asDiagonal()).cwiseAbs();
  const double largest = scaled.nonZeros() > 0 ? scaled.coeffs().maxCoeff() : 0;
  if (largest == 0) return {.determined = true};
  double least = largest;
  for (const double size : scaled.coeffs())
    if (size > kRoundoff * largest) least = std::min(least, size);
  // Largest load factor t to check. The nonzero entries of t B = -t K_G then exceed those of K at
  // least a thousandfold, unless the largest entry would exceed 1e10. The stiffness of unloaded
  // members then loses at most ten digits.
  const double farthest = std::min(1e3 / least, 1e10 / largest);
  double counted = 0;
  const auto has_factor_below = [&](double t) -> std::optional<bool> {
    // Reduce the load factor t until no pivot of K + t K_G is near zero.
    for (const double share : {1.0, 0.93, 0.87}) {
      counted = share * t;
      ++counters.factorizations;
      if (const auto count = factorization.sturm_count(shifted_matrix(K, B, counted)))
        return *count > 0;
    }
    return {};
  };
  std::optional<bool> has = has_factor_below(farthest);
  first.checked = counted;
  double above = counted;
  constexpr double ratio = 0.25;
  for (int i = 0; has && *has && i < kHalvings; ++i) {
    first.exists = true;
    has = has_factor_below(ratio * above);
    if (has && *has) above *= ratio;
  }
  first.below = 0.87 * ratio * above;
  first.determined = has && !*has;
  return first;
}

}  // namespace

BucklingSolution solve_buckling(const System& system, const BucklingOptions& options) {
  BucklingSolution solution;
  const StaticSolution statics = solve_statics(system);
  solution.counters = statics.counters;
  solution.outcome = statics.outcome;
  solution.evidence = statics.evidence;
  if (!statics.outcome.solved() || statics.q.size() == 0) return solution;
  solution.outcome = require_determinate_prestress(system);
  if (!solution.outcome.solved()) return solution;
  const auto forces = prestress_of(system, system.T * statics.q, system.load, body_forces(system));
  const SparseMatrix softening = -geometric_stiffness(system, forces);
  Factorization factorization;
  const auto first = bracket_first_factor(system.K, softening, factorization, solution.counters);
  if (!first.determined) {
    solution.outcome = {Status::not_converged,
                        "buckling factors cannot be counted: round-off dominates the pivots"};
    return solution;
  }
  solution.checked_factor = first.checked;
  if (!first.exists) {
    solution.evidence.add(Residual::mode_count, 0);
    return solution;
  }
  Pencil pencil;
  pencil.K = &system.K;
  pencil.B = &softening;
  pencil.indefinite = true;
  // The shift is required because members in large tension have negative factors of small
  // magnitude. Without the shift, 1 / factor of these members would be the largest eigenvalues.
  // Their round-off errors would hide positive factors.
  pencil.shift = first.below;
  pencil.K_times = stiffness_operator(system);
  pencil.K_products = [&system](const Eigen::MatrixXd& X) {
    return projected_stiffness(system, system.T * X);
  };
  factorization.compute(shifted_matrix(system.K, softening, pencil.shift));
  ++solution.counters.factorizations;
  const Eigen::MatrixXd no_null(system.K.rows(), 0);
  const Eigenpairs pairs = lowest_eigenpairs(pencil, no_null, options.count, options.method,
                                             factorization, solution.counters);
  solution.outcome = pairs.outcome;
  solution.load_factor = pairs.value;
  solution.shape = pairs.vector;
  solution.roundoff.resize(pairs.value.size());
  const Prestress roundoff = prestress_roundoff(system, statics.q);
  for (Index j = 0; j < pairs.value.size(); ++j) {
    const Eigen::VectorXd x = pairs.vector.col(j);
    const double elastic = strain_energy_roundoff(system, system.T * x) / pairs.value[j];
    const double geometric = geometric_energy_roundoff(system, softening, roundoff, x);
    solution.roundoff[j] = elastic + geometric + pairs.error[j] + 4 * kEps;
  }
  RowBalance<double> rows(system, pairs.value.size());
  rows.add_elastic_forces(system.T * pairs.vector);
  rows.add(softening, pairs.vector * (-pairs.value).asDiagonal());
  if (pairs.value.size() > 0)
    solution.evidence.add(Residual::eigenvalue_equation, rows.backward_error());
  if (!solution.outcome.solved()) return solution;
  const double missed = eigenvalue_count_error(system.K, softening, solution.load_factor,
                                               std::move(factorization), pairs.check_shift);
  const auto twice = static_cast<double>(count_dependent_vectors(system.K, solution.shape));
  solution.evidence.add(Residual::mode_count, missed + twice);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
  return solution;
}

}  // namespace trammel::solver
