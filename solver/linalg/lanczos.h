#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/model/numbers.h"

namespace trammel::solver {

struct LanczosOptions {
  Index wanted = 1;    ///< eigenvalues, below the operator's size
  Index subspace = 2;  ///< vectors kept between restarts, above `wanted`
  double tolerance = 1e-9;
};

/// Those that converged; there may be fewer than were wanted, or none.
struct LanczosPairs {
  Eigen::VectorXd value;   ///< descending
  Eigen::MatrixXd vector;  ///< one a column
};

/// Largest eigenvalues of a symmetric operator, by Lanczos' method with implicit restarts
/// (Spectra).
[[nodiscard]] LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options);

}  // namespace trammel::solver
