#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <concepts>
#include <unsupported/Eigen/AutoDiff>

/// Derivatives without differences: the functions that make elements out of a design are templates
/// over `Real`, and d/dp of everything comes out of the very same lines. A dual number carries it
/// exactly. A complex step carries it as an imaginary part so small that its square is nothing
/// beside the real one: f(p + ih) = f + ih f' + O(h^2), with no difference to cancel
/// (W. Squire, G. Trapp, SIAM Review 40, 1998).
namespace trammel::solver {

/// A value and its derivative with respect to one parameter.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using Complex = std::complex<double>;
/// h, in the parameter's unit: h^2 is below the round-off of any number that a design holds.
inline constexpr double kComplexStep = 1e-30;

template <class T>
concept Real = std::same_as<T, double> || std::same_as<T, Dual> || std::same_as<T, Complex>;

[[nodiscard]] inline double value(double x) {
  return x;
}
[[nodiscard]] inline double value(const Dual& x) {
  return x.value();
}
[[nodiscard]] inline double value(const Complex& x) {
  return x.real();
}
[[nodiscard]] inline double derivative(const Dual& x) {
  return x.derivatives()[0];
}
[[nodiscard]] inline double derivative(const Complex& x) {
  return x.imag() / kComplexStep;
}

/// A number with d/dp = `derivative`: the parameter itself has 1.
template <Real T>
[[nodiscard]] T with_derivative(double value, double derivative) {
  if constexpr (std::same_as<T, Dual>) {
    return {value, Eigen::Matrix<double, 1, 1>(derivative)};
  } else {
    return {value, derivative * kComplexStep};
  }
}

/// Of numbers that carry a complex step; the library has no complex one.
[[nodiscard]] inline Complex atan2(const Complex& y, const Complex& x) {
  const double turn = x.real() * y.imag() - y.real() * x.imag();
  return {std::atan2(y.real(), x.real()), turn / (x.real() * x.real() + y.real() * y.real())};
}

}  // namespace trammel::solver
