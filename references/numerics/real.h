#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <vector>

/// Extended precision (50 decimal digits) for derived references. Roots of characteristic equations
/// are computed in this precision, and the results are rounded to double.
namespace trammel::references {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type,
                                           boost::multiprecision::et_off>;

template <class T>
[[nodiscard]] T pi() {
  static const T value = acos(T(-1));
  return value;
}

/// Returns the function C at x and its integral S from 0 to x, for a given k^2. If k^2 > 0, C is
/// cosh(k x), and both values are divided by cosh(k x). Otherwise C is cos(|k| x).
template <class T>
[[nodiscard]] std::array<T, 2> scaled_cosine_and_integral(const T& k2, const T& x) {
  using std::cos, std::sin, std::sqrt, std::tanh;
  if (k2 == 0) return {T(1), x};
  const T k = sqrt(k2 > 0 ? k2 : T(-k2));
  if (k2 > 0) return {T(1), tanh(k * x) / k};
  return {cos(k * x), sin(k * x) / k};
}

/// Returns the root of `f` between lo and hi, where f changes sign, to 45 digits.
/// @throws DerivationError  if f does not change sign.
[[nodiscard]] Real refined_root(const std::function<Real(const Real&)>& f, const Real& lo,
                                const Real& hi);

/// Returns the first `count` sign changes of `f` above `start`, found on a grid with the given
/// spacing. The caller ensures that the spacing is smaller than the distance between two roots.
/// @throws DerivationError  if fewer sign changes are found below start + 1e5 steps.
[[nodiscard]] std::vector<Real> first_roots(const std::function<Real(const Real&)>& f,
                                            const Real& start, const Real& spacing, int count);

}  // namespace trammel::references
