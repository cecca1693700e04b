#pragma once

#include <limits>

namespace trammel {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace trammel
