#include "harness/base/statistic.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/base/number.h"

namespace trammel::harness {

double statistic_of(const std::string& name, const std::vector<double>& values) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (values.empty() || !std::ranges::all_of(values, is_finite)) return kNaN;
  const auto [least, most] = std::ranges::minmax_element(values);
  const auto count = static_cast<double>(values.size());
  if (name == "max") return *most;
  if (name == "min") return *least;
  if (name == "max_abs") return std::max(std::abs(*least), std::abs(*most));
  if (name == "sum") return std::accumulate(values.begin(), values.end(), 0.0);
  if (name == "mean") return std::accumulate(values.begin(), values.end(), 0.0) / count;
  if (name == "median") return quantile(values, 0.5);
  if (name == "first") return values.front();
  if (name == "last") return values.back();
  if (name == "range") return *most - *least;
  if (name == "rms")
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / count);
  return kNaN;
}

double quantile(std::vector<double> values, double fraction) {
  std::ranges::sort(values);
  const double at = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], at - static_cast<double>(below));
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
