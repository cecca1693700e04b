#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

/// Number types and constants that all folders of the solver use.
namespace trammel::solver {

using Index = Eigen::Index;

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Converts an index >= 0 to an unsigned size.
[[nodiscard]] inline std::size_t to_size(Index index) {
  return static_cast<std::size_t>(index);
}

/// Returns the larger of two numbers, or NaN if one of them is NaN. std::max would lose a NaN,
/// because std::max returns its first argument if the comparison is false.
[[nodiscard]] inline double nan_max(double a, double b) {
  return std::isnan(a) || b <= a ? a : b;
}

// Dual numbers, which yield exact derivatives instead of finite differences. The functions that
// build elements from a design are templates, in which a number is a double or a Dual. With Dual,
// the same functions also compute derivatives with respect to a design parameter.

/// Dual number: a value and its derivative with respect to one parameter.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

template <class T>
concept Real = std::same_as<T, double> || std::same_as<T, Dual>;

[[nodiscard]] inline double value(double x) {
  return x;
}
/// Returns the value of a dual number without its derivative.
[[nodiscard]] inline double value(const Dual& x) {
  return x.value();
}
/// Returns the derivative that a dual number contains.
[[nodiscard]] inline double derivative(const Dual& x) {
  return x.derivatives()[0];
}
/// Returns a dual number with the given derivative. For the parameter itself, `derivative` is 1.
[[nodiscard]] inline Dual with_derivative(double value, double derivative) {
  return {value, Eigen::Matrix<double, 1, 1>(derivative)};
}

}  // namespace trammel::solver
