#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/model/counters.h"

namespace trammel::solver {

/// A symmetric operator on the free coordinates, x -> A x, more exact than its assembled matrix.
using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct RefinedSolution {
  Eigen::VectorXd x;
  double correction = 0;  ///< the last one over x: what is left of the error is about its square
                          ///< over the one before; near 1 or above, x means nothing
  /// False where the condition number has eaten all digits.
  [[nodiscard]] bool converged() const { return correction < 1e-4; }
};

/// x with A x = b where A has been factored, improved with residuals from `A`. Stops when the
/// correction is so small that its own error is rounding, or no longer halves. (The residual itself
/// would not do to tell: the rounding of stiff axial parts hides what is left in soft bending.)
/// @param guess  a good one costs a single solve.
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                                            Counters& counters);
[[nodiscard]] RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, Counters& counters);

}  // namespace trammel::solver
