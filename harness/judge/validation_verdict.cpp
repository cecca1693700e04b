#include "harness/judge/validation_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

using results::Comparison;
using results::ValidationVerdict;

constexpr double kRepeated = 1e-6;

void compare(const Comparison& c, ValidationVerdict& v) {
  // Not std::hypot of three, which may lose a NaN.
  v.u_val =
      std::sqrt(*c.u_num * *c.u_num + *v.u_input * *v.u_input + *c.u_reference * *c.u_reference);
  const double noise = kCoverageFactor * *v.u_val;
  v.interval = {*c.difference - noise, *c.difference + noise};
  v.verdict = kUndecided;
  if (!c.difference || !v.u_val) return;
  v.verdict = std::abs(*c.difference) <= noise ? kWithinUncertainty : kModelError;
}

/// One past the last entry whose computed value is that of `first`.
std::size_t end_of_repeated(std::span<const Comparison> row, std::size_t first) {
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
  bool beyond_digits;  ///< wider than the printed digits allow
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

std::string contradiction(const Spread& spread, std::size_t first, std::size_t end,
                          const std::string& unit) {
  return fmt::format(
      "the reference is inconsistent: values {} to {} are equal by symmetry "
      "but printed as {} to {} {}",
      first + 1, end, rounded(spread.low, 6), rounded(spread.high, 6), unit);
}

}  // namespace

void evaluate_validation_row(std::span<Comparison> row) {
  for (std::size_t first = 0; first < row.size();) {
    const std::size_t end = end_of_repeated(row, first);
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
          v->conclusion = contradiction(spread, first, end, c.unit);
        } else {
          v->conclusion = describe_validation(c, *v);
        }
      }
    }
    first = end;
  }
}

}  // namespace trammel::harness
