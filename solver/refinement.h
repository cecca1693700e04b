#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/factorization.h"
#include "solver/system.h"

namespace trammel {

/// A symmetric operator on the free coordinates, x -> A x, more exact than its assembled matrix.
using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// K x from the elements' deformations.
[[nodiscard]] Operator stiffness_operator(const System& system);

/// x with A x = b where A has been factored, improved with residuals from `A`. Stops when the
/// correction is so small that its own error is rounding, or no longer halves. (The residual itself
/// would not do to tell: the rounding of stiff axial parts hides what is left in soft bending.)
[[nodiscard]] Eigen::VectorXd refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, Counters& counters);

/// The same from a guess; a good one costs a single solve.
[[nodiscard]] Eigen::VectorXd refined_solve(const Operator& A, const Factorization& factorization,
                                            const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                                            Counters& counters);

}  // namespace trammel
