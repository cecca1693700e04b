#pragma once

#include <string>
#include <vector>

namespace trammel::harness {

/// One number from many. NaN comes through.
/// @param name  "max", "min", "max_abs", ... as in the schema
[[nodiscard]] double statistic_of(const std::string& name, const std::vector<double>& values);

/// Largest absolute value; 0 where there is none.
[[nodiscard]] double max_abs(const std::vector<double>& values);

}  // namespace trammel::harness
