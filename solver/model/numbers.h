#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

/// Numbers that every room uses.
namespace trammel::solver {

using Index = Eigen::Index;

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

[[nodiscard]] inline std::size_t to_size(Index index) {
  return static_cast<std::size_t>(index);
}

/// The larger of two numbers, NaN where either is one: std::max, which keeps its first argument
/// where they do not compare, would lose it.
[[nodiscard]] inline double nan_max(double a, double b) {
  return std::isnan(a) || b <= a ? a : b;
}

}  // namespace trammel::solver
