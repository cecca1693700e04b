#pragma once

#include <limits>

namespace trammel::harness {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace trammel::harness
