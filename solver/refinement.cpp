#include "solver/refinement.h"

#include "solver/strain.h"

namespace trammel {

Operator stiffness_operator(const System& system) {
  return [&system](const Eigen::VectorXd& q) -> Eigen::VectorXd {
    return system.T.transpose() * internal_forces(system, system.T * q);
  };
}

Eigen::VectorXd refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, Counters& counters) {
  const Eigen::VectorXd x = factorization.solve(b);
  ++counters.solves;
  return refined_solve(A, factorization, b, x, counters);
}

Eigen::VectorXd refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                              Counters& counters) {
  constexpr int kMostSteps = 8;
  constexpr double kSmall = 1e-10;  // a correction whose own error no longer counts
  Eigen::VectorXd x = guess;
  double last = x.norm();
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd correction = factorization.solve(b - A(x));
    ++counters.solves;
    const double size = correction.norm();
    if (!(size < last)) break;  // it no longer converges: what is left is rounding, or hopeless
    x += correction;
    if (size <= kSmall * x.norm() || size > 0.5 * last) break;
    last = size;
  }
  return x;
}

}  // namespace trammel
