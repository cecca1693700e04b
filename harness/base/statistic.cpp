#include "harness/base/statistic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trammel::harness {

double statistic_of(const std::string& name, const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const bool finite = std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
  if (!finite) return std::numeric_limits<double>::quiet_NaN();
  const auto [least, most] = std::ranges::minmax_element(values);
  const auto count = static_cast<double>(values.size());
  if (name == "max") return *most;
  if (name == "min") return *least;
  if (name == "max_abs") return std::max(std::abs(*least), std::abs(*most));
  if (name == "min_abs")
    return std::abs(*std::ranges::min_element(
        values, [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (name == "sum") return std::accumulate(values.begin(), values.end(), 0.0);
  if (name == "mean") return std::accumulate(values.begin(), values.end(), 0.0) / count;
  if (name == "median") {
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
  if (name == "first") return values.front();
  if (name == "last") return values.back();
  if (name == "range") return *most - *least;
  if (name == "rms")
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / count);
  return std::numeric_limits<double>::quiet_NaN();
}

double upper_median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

double max_abs(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

LargestDifference largest_difference(const std::vector<double>& a, const std::vector<double>& b,
                                     const std::function<double(std::size_t)>& scale) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (a.size() != b.size()) return {kInfinite, 0};
  LargestDifference largest;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    const double difference = std::abs(a[i] - b[i]) / scale(i);
    const double size = std::isnan(difference) ? kInfinite : difference;
    if (size > largest.value) largest = {size, i};
  }
  return largest;
}

}  // namespace trammel::harness
