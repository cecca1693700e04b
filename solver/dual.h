#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <unsupported/Eigen/AutoDiff>

/// Exact derivatives: the functions that make elements out of a design are templates over `Real`,
/// and a dual number carries d/dp of everything through the very same lines.
namespace trammel {

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
[[nodiscard]] inline double slope(const Dual& x) {
  return x.derivatives()[0];
}

/// The parameter itself: d/dp = `slope`.
[[nodiscard]] inline Dual dual(double value, double slope) {
  return {value, Eigen::Matrix<double, 1, 1>(slope)};
}

}  // namespace trammel
