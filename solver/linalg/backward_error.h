#pragma once

#include <Eigen/Core>

namespace trammel::solver {

/// Backward error of equations, row by row: the largest |residual| over the sum of the magnitudes
/// of its terms; 0 / 0 counts as 0, what is not a number as infinite.
/// Source: Oettli and Prager (1964).
[[nodiscard]] double largest_ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& terms);

/// No row is judged by coordinates or forces that are rounding of the others: each counts with at
/// least this share of the largest.
inline constexpr double kLeastShare = 1e-3;

}  // namespace trammel::solver
