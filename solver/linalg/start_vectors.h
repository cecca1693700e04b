#pragma once

#include <Eigen/Core>

#include "solver/model/numbers.h"

namespace trammel::solver {

/// Columns for an eigenvalue iteration to start from: numbers in [-1, 1), the same everywhere.
/// @param variant  another sequence
[[nodiscard]] Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant = 0);

}  // namespace trammel::solver
