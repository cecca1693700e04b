#include "harness/judge/input_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr double kStep = 1.0 / 16;

/// Returns a random number in [0, 1). Unlike std::uniform_real_distribution, it yields the same
/// sequence with every C++ library.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// Returns samples in [-1, 1], with a row per sample and a column per input. In each column, each
/// of `count` equal cells of the range contains one sample.
std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t inputs,
                                                 std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<std::vector<double>> points(count, std::vector<double>(inputs));
  std::vector<std::size_t> cell(count);
  for (std::size_t k = 0; k < inputs; ++k) {
    for (std::size_t i = 0; i < count; ++i) cell[i] = i;
    for (std::size_t i = count - 1; i > 0; --i)
      std::swap(cell[i], cell[static_cast<std::size_t>(uniform(generator) * (i + 1.0))]);
    for (std::size_t i = 0; i < count; ++i) {
      const double at = static_cast<double>(cell[i]) + uniform(generator);
      points[i][k] = 2 * at / static_cast<double>(count) - 1;
    }
  }
  return points;
}

double standard_deviation(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) square += (value - mean) * (value - mean);
  return std::sqrt(square / (n - 1));
}

}  // namespace

std::optional<std::vector<std::vector<double>>> uncertainty_by_derivatives(
    const Response& response, const std::vector<double>& half_widths) {
  std::vector<std::vector<double>> contributions;
  for (std::size_t k = 0; k < half_widths.size(); ++k) {
    std::vector<double> offsets(half_widths.size(), 0.0);
    offsets[k] = kStep * half_widths[k];
    const auto above = response(offsets);
    offsets[k] = -offsets[k];
    const auto below = response(offsets);
    if (!above || !below || above->size() != below->size()) return std::nullopt;
    std::vector<double> contribution;
    for (std::size_t i = 0; i < above->size(); ++i)
      contribution.push_back(((*above)[i] - (*below)[i]) / (2 * kStep * std::sqrt(3.0)));
    contributions.push_back(std::move(contribution));
  }
  return contributions;
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
    result.standard.push_back(standard_deviation(values));
  }
  return result;
}

namespace {

using results::Comparison;
using results::ValidationVerdict;

constexpr double kRepeated = 1e-6;

void compare(const Comparison& c, ValidationVerdict& v) {
  // The square root is used, because std::hypot of three numbers may ignore a NaN.
  v.u_val =
      std::sqrt(*c.u_num * *c.u_num + *v.u_input * *v.u_input + *c.u_reference * *c.u_reference);
  const double noise = kCoverageFactor * *v.u_val;
  v.interval = {*c.difference - noise, *c.difference + noise};
  v.verdict = kUndecided;
  if (!c.difference || !v.u_val) return;
  v.verdict = std::abs(*c.difference) <= noise ? kWithinUncertainty : kModelError;
}

/// Returns the index after the last consecutive entry whose computed value equals that of entry
/// `first`.
std::size_t end_of_equal_values(std::span<const Comparison> row, std::size_t first) {
  const double value = *row[first].simulation;
  std::size_t end = first + 1;
  while (end < row.size() &&
         std::abs(*row[end].simulation - value) <= kRepeated * std::abs(value)) {
    ++end;
  }
  return end;
}

struct Spread {
  double low, high;
  /// True: the range of printed values exceeds the uncertainty of the printed digits.
  bool beyond_digits;
};

Spread printed(std::span<const Comparison> equal) {
  const auto [low, high] = std::ranges::minmax_element(equal, {}, &Comparison::expected);
  const double range = *high->expected - *low->expected;
  const double digits_allow = kCoverageFactor * std::hypot(*low->u_reference, *high->u_reference);
  return {*low->expected, *high->expected, range > digits_allow};
}

std::string describe_validation(const Comparison& c, const ValidationVerdict& v) {
  if (v.verdict == kUndecided)
    return "undecided: the value or one of its uncertainties could not be computed";
  if (v.verdict == kWithinUncertainty)
    return fmt::format("the difference of {} {} is within the validation uncertainty of ±{} {}",
                       rounded(*c.difference, 3), c.unit, rounded(kCoverageFactor * *v.u_val, 3),
                       c.unit);
  const auto [a, b] = std::minmax({std::abs(*v.interval[0]), std::abs(*v.interval[1])});
  return fmt::format("model error between {} and {} {}, too {}", rounded(a, 3), rounded(b, 3),
                     c.unit, *c.difference > 0 ? "high" : "low");
}

std::string describe_unequal_references(const Spread& spread, std::size_t first, std::size_t end,
                                        const std::string& unit) {
  return fmt::format(
      "the reference is inconsistent: values {} to {} are equal by symmetry "
      "but printed as {} to {} {}",
      first + 1, end, rounded(spread.low, 6), rounded(spread.high, 6), unit);
}

}  // namespace

void evaluate_validation_row(std::span<Comparison> row) {
  for (std::size_t first = 0; first < row.size();) {
    const std::size_t end = end_of_equal_values(row, first);
    const Spread spread = printed(row.subspan(first, end - first));
    for (Comparison& c : row.subspan(first, end - first)) {
      c.difference = *c.simulation - *c.expected;
      for (ValidationVerdict* v : {static_cast<ValidationVerdict*>(&c), &c.all_inputs}) {
        compare(c, *v);
        const double noise = kCoverageFactor * *v->u_val;
        const bool between =
            *c.simulation >= spread.low - noise && *c.simulation <= spread.high + noise;
        if (v->verdict == kModelError && spread.beyond_digits && between) {
          v->verdict = kReferenceInconsistent;
          v->conclusion = describe_unequal_references(spread, first, end, c.unit);
        } else {
          v->conclusion = describe_validation(c, *v);
        }
      }
    }
    first = end;
  }
}

}  // namespace trammel::harness
