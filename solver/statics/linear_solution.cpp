#include "solver/statics/linear_solution.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/length_scales.h"
#include "solver/assembly/stiffness_factors.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/forward_error.h"
#include "solver/linalg/refinement.h"
#include "solver/statics/describe_mechanism.h"

namespace trammel::solver {

using Eigen::VectorXd;

StaticState solve_linear_statics(const System& system, Counters& counters) {
  StaticState solution;
  Factorization factorization;
  factorization.compute(system.K);
  ++counters.factorizations;
  solution.outcome = require_held(system, factorization, counters);
  if (!solution.outcome.solved()) return solution;
  const StiffnessFactors factors = stiffness_factors(system);
  const SparseMatrix R = free_length_scales(system);
  const auto take = [&](const VectorXd& q, double left, const Operator& inverse) {
    solution.q = q;
    const double bound = forward_error(factors, R, q, system.f, inverse);
    solution.error = bound + left;
    return left <= bound;  // not for NaN
  };
  const auto solve = [&](const VectorXd& b) -> VectorXd {
    ++counters.solves;
    return factorization.solve(b);
  };
  const auto by_stiffness = [&] {
    if (!factorization.exists() || factorization.smallest_pivot() <= 0) return false;
    const Operator K = stiffness_operator(system);
    const RefinedSolution first = refined_solve(K, factorization, system.f, counters);
    const VectorXd left = solve(system.f - K(first.x));
    return take(first.x, left.norm() == 0 ? 0 : left.norm() / first.x.norm(), solve);
  };
  if (!by_stiffness()) {
    const AugmentedSystem augmented(factors);
    ++counters.factorizations;
    if (augmented.exists()) {
      const RefinedSolution found = augmented.solve(system.f);
      take(found.x, found.correction,
           [&](const VectorXd& b) -> VectorXd { return augmented.solve(b).x; });
    }
  }
  solution.outcome = outcome_by_error(solution.error);
  return solution;
}

Outcome outcome_by_error(double error) {
  if (error < 0.1) return {};
  return {Status::not_converged,
          "the model is too ill-conditioned for double precision: less than one digit of the "
          "displacements would be right"};
}

double force_roundoff(const System& system, const VectorXd& q) {
  const VectorXd length = length_scales(system);
  const VectorXd u = system.T * q;
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

}  // namespace trammel::solver
