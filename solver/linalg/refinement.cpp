#include "solver/linalg/refinement.h"

#include <limits>

namespace trammel::solver {

RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, Counters& counters) {
  const Eigen::VectorXd x = factorization.solve(b);
  ++counters.solves;
  return refined_solve(A, factorization, b, x, counters);
}

RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                              Counters& counters) {
  constexpr int kMaxSteps = 8;
  constexpr double kSmall = 1e-10;  // a correction whose own error no longer counts
  RefinedSolution result{guess, 0};
  double last = std::numeric_limits<double>::infinity();  // of a guess nothing is known
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd correction = factorization.solve(b - A(result.x));
    ++counters.solves;
    // In the scaling of the matrix, so that meters and radians have one unit.
    const double size = correction.cwiseQuotient(factorization.scaling()).norm();
    const double whole = result.x.cwiseQuotient(factorization.scaling()).norm();
    result.correction = size == 0 ? 0 : size / whole;
    if (!(size < last)) break;  // it no longer converges: what is left is rounding, or hopeless
    result.x += correction;
    if (size <= kSmall * whole || size > 0.5 * last) break;
    last = size;
  }
  return result;
}

}  // namespace trammel::solver
