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
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options);

/// Columns for an eigenvalue iteration to start from: numbers in [-1, 1), the same everywhere.
/// @param variant  another sequence
[[nodiscard]] Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant = 0);

}  // namespace trammel::solver
