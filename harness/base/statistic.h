#pragma once

#include <string>
#include <vector>

namespace trammel {

/// One number from many. NaN comes through.
/// @param name  "max", "min", "max_abs", ... as in the schema
[[nodiscard]] double statistic_of(const std::string& name, const std::vector<double>& values);

}  // namespace trammel
