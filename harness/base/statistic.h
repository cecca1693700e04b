#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace trammel::harness {

/// One number from many. NaN comes through.
/// @param name  "max", "min", "max_abs", ... as in the schema
[[nodiscard]] double statistic_of(const std::string& name, const std::vector<double>& values);

/// The upper of the two middle values if their number is even.
/// @param values  at least one
[[nodiscard]] double upper_median(std::vector<double> values);

/// Largest absolute value; 0 where there is none.
[[nodiscard]] double max_abs(const std::vector<double>& values);

struct LargestDifference {
  double value = 0;
  std::size_t index = 0;
};

/// Largest |a - b| of all entries, each over its own scale. Equal entries differ by 0 whatever the
/// scale; infinite where the lengths differ, a number is none, or a scale is 0.
[[nodiscard]] LargestDifference largest_difference(const std::vector<double>& a,
                                                   const std::vector<double>& b,
                                                   const std::function<double(std::size_t)>& scale);

}  // namespace trammel::harness
