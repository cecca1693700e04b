#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

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

// Derivatives without differences: the functions that make elements out of a design are templates
// over `Real`, and d/dp of everything comes out of the very same lines.

/// A value and its derivative with respect to one parameter.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

template <class T>
concept Real = std::same_as<T, double> || std::same_as<T, Dual>;

[[nodiscard]] inline double value(double x) {
  return x;
}
[[nodiscard]] inline double value(const Dual& x) {
  return x.value();
}
[[nodiscard]] inline double derivative(const Dual& x) {
  return x.derivatives()[0];
}
/// A number with d/dp = `derivative`: the parameter itself has 1.
[[nodiscard]] inline Dual with_derivative(double value, double derivative) {
  return {value, Eigen::Matrix<double, 1, 1>(derivative)};
}

}  // namespace trammel::solver
