#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

/// The extended precision in which references are derived: 50 decimal digits, rounded to a double
/// only at the very end.
namespace trammel::references {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type,
                                           boost::multiprecision::et_off>;

/// pi in the precision of T.
template <class T>
[[nodiscard]] T pi() {
  static const T value = acos(T(-1));
  return value;
}

}  // namespace trammel::references
