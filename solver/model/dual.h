#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <unsupported/Eigen/AutoDiff>

/// Derivatives without differences: the functions that make elements out of a design are templates
/// over `Real`, and d/dp of everything comes out of the very same lines.
namespace trammel::solver {

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
