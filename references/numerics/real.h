#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <functional>
#include <vector>

/// The extended precision in which references are derived: 50 decimal digits, rounded to a double
/// only at the very end; and the roots of characteristic equations in it.
namespace trammel::references {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type,
                                           boost::multiprecision::et_off>;

/// pi in the precision of T.
template <class T>
[[nodiscard]] T pi() {
  static const T value = acos(T(-1));
  return value;
}

/// Returns the root of `f` between lo and hi, where f changes sign, to 45 digits.
/// @throws DerivationError  if f does not change sign.
[[nodiscard]] Real refined_root(const std::function<Real(const Real&)>& f, const Real& lo,
                                const Real& hi);

/// Returns the first `count` sign changes of `f` above `start`, found on a grid of spacing `step`.
/// The caller ensures that the step is shorter than the distance between two roots.
/// @throws DerivationError  if fewer are found below start + 1e5 steps.
[[nodiscard]] std::vector<Real> first_roots(const std::function<Real(const Real&)>& f,
                                            const Real& start, const Real& step, int count);

}  // namespace trammel::references
