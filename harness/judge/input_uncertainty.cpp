#include "harness/judge/input_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace trammel::harness {
namespace {

constexpr double kStep = 1.0 / 16;

/// In [0, 1); std::uniform_real_distribution is not the same everywhere.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// Points x inputs in [-1, 1]: each column a shuffled visit of `count` equal cells.
std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t inputs,
                                                 std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<std::vector<double>> points(count, std::vector<double>(inputs));
  std::vector<std::size_t> cell(count);
  for (std::size_t k = 0; k < inputs; ++k) {
    for (std::size_t i = 0; i < count; ++i) cell[i] = i;
    for (std::size_t i = count - 1; i > 0; --i) {
      std::swap(cell[i], cell[static_cast<std::size_t>(uniform(generator) * (i + 1.0))]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double at = static_cast<double>(cell[i]) + uniform(generator);
      points[i][k] = 2 * at / static_cast<double>(count) - 1;
    }
  }
  return points;
}

/// Linear between the order statistics of sorted values.
double quantile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

void summarise(std::vector<double> values, SampledUncertainty& result) {
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double value : values) mean += value / n;
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  result.mean.push_back(mean);
  result.standard.push_back(std::sqrt(square / (n - 1)));
  result.low.push_back(quantile(values, 0.025));
  result.high.push_back(quantile(values, 0.975));
}

}  // namespace

std::optional<PropagatedUncertainty> uncertainty_by_derivatives(
    const Response& response, const std::vector<double>& half_widths) {
  PropagatedUncertainty result;
  for (std::size_t k = 0; k < half_widths.size(); ++k) {
    std::vector<double> offsets(half_widths.size(), 0.0);
    offsets[k] = kStep * half_widths[k];
    const auto above = response(offsets);
    offsets[k] = -offsets[k];
    const auto below = response(offsets);
    if (!above || !below || above->size() != below->size()) return std::nullopt;
    std::vector<double> contribution;
    for (std::size_t i = 0; i < above->size(); ++i) {
      contribution.push_back(((*above)[i] - (*below)[i]) / (2 * kStep * std::sqrt(3.0)));
    }
    result.contribution.push_back(std::move(contribution));
  }
  if (result.contribution.empty()) return result;
  for (std::size_t i = 0; i < result.contribution.front().size(); ++i) {
    double square = 0;
    for (const auto& contribution : result.contribution)
      square += contribution[i] * contribution[i];
    result.standard.push_back(std::sqrt(square));
  }
  return result;
}

SampledUncertainty uncertainty_by_sampling(const Response& response,
                                           const std::vector<double>& half_widths, int count,
                                           std::uint64_t seed) {
  SampledUncertainty result;
  std::vector<std::vector<double>> outputs;
  for (auto& point : latin_hypercube(static_cast<std::size_t>(count), half_widths.size(), seed)) {
    for (std::size_t k = 0; k < point.size(); ++k) point[k] *= half_widths[k];
    auto output = response(point);
    if (!output || (!outputs.empty() && output->size() != outputs.front().size())) {
      ++result.failed;
      continue;
    }
    outputs.push_back(std::move(*output));
  }
  result.samples = static_cast<int>(outputs.size());
  if (result.samples < 2) return result;
  for (std::size_t i = 0; i < outputs.front().size(); ++i) {
    std::vector<double> values;
    values.reserve(outputs.size());
    for (const auto& output : outputs) values.push_back(output[i]);
    summarise(std::move(values), result);
  }
  return result;
}

}  // namespace trammel::harness
