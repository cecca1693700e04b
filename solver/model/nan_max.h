#pragma once

#include <cmath>

namespace trammel {

/// The larger of two numbers, NaN where either is one: std::max, which keeps its first argument
/// where they do not compare, would lose it.
[[nodiscard]] inline double larger(double a, double b) {
  return std::isnan(a) || b <= a ? a : b;
}

}  // namespace trammel
