#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace trammel::harness {

/// Returns a statistic of numbers; NaN if the list is empty or contains a non-finite number.
/// @param name  "max", "min", "max_abs", ... as in the schema
[[nodiscard]] double statistic_of(const std::string& name, const std::vector<double>& values);

/// Returns the quantile of the values by linear interpolation between the sorted values.
/// @param fraction  fraction of the values below the quantile: 0.5 for the median
[[nodiscard]] double quantile(std::vector<double> values, double fraction);

/// Returns the largest absolute value; 0 for an empty list.
[[nodiscard]] double max_abs(const std::vector<double>& values);

struct LargestDifference {
  double value = 0;
  std::size_t index = 0;
};

/// Returns the largest |a[i] - b[i]| / scale(i) of two lists and its index. Equal numbers differ by
/// 0. The result is infinite if the lengths differ, a value is NaN, or a scale is 0.
[[nodiscard]] LargestDifference largest_difference(const std::vector<double>& a,
                                                   const std::vector<double>& b,
                                                   const std::function<double(std::size_t)>& scale);

}  // namespace trammel::harness
