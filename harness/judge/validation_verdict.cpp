#include "harness/judge/validation_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr double kRepeated = 1e-6;

Validation compare(const Comparison& c) {
  Validation v;
  v.difference = c.simulation - c.reference;
  // Not std::hypot of three, which may lose a NaN.
  v.u_val = std::sqrt(c.u_num * c.u_num + c.u_input * c.u_input + c.u_reference * c.u_reference);
  v.low = v.difference - kCoverageFactor * v.u_val;
  v.high = v.difference + kCoverageFactor * v.u_val;
  if (!std::isfinite(v.difference) || !std::isfinite(v.u_val)) {
    v.verdict = ValidationVerdict::undecided;
    return v;
  }
  const bool within = v.low <= 0 && v.high >= 0;
  v.verdict = within ? ValidationVerdict::within_validation_uncertainty
                     : ValidationVerdict::beyond_validation_uncertainty;
  return v;
}

/// One past the last entry whose computed value is that of `first`.
std::size_t end_of_repeated(const std::vector<Comparison>& row, std::size_t first) {
  const double value = row[first].simulation;
  std::size_t end = first + 1;
  while (end < row.size() && std::abs(row[end].simulation - value) <= kRepeated * std::abs(value)) {
    ++end;
  }
  return end;
}

struct Spread {
  double low, high;
  bool beyond_digits;  ///< wider than the printed digits allow
};

Spread printed(const std::vector<Comparison>& row, std::size_t first, std::size_t end) {
  const auto by_value = [](const Comparison& a, const Comparison& b) {
    return a.reference < b.reference;
  };
  const auto begin = row.begin();
  const auto [low, high] = std::minmax_element(begin + static_cast<std::ptrdiff_t>(first),
                                               begin + static_cast<std::ptrdiff_t>(end), by_value);
  const double digits_allow = kCoverageFactor * std::hypot(low->u_reference, high->u_reference);
  return {low->reference, high->reference, high->reference - low->reference > digits_allow};
}

std::string describe_validation(const Validation& v, const std::string& unit) {
  const double noise = kCoverageFactor * v.u_val;
  if (v.verdict == ValidationVerdict::undecided) {
    return "undecided: the value or one of its uncertainties could not be computed";
  }
  if (v.verdict == ValidationVerdict::within_validation_uncertainty) {
    return fmt::format("the difference of {} {} is within the validation uncertainty of ±{} {}",
                       rounded(v.difference, 3), unit, rounded(noise, 3), unit);
  }
  const double a = std::min(std::abs(v.low), std::abs(v.high));
  const double b = std::max(std::abs(v.low), std::abs(v.high));
  return fmt::format("model error between {} and {} {}, too {}", rounded(a, 3), rounded(b, 3), unit,
                     v.difference > 0 ? "high" : "low");
}

std::string contradiction(const Spread& spread, std::size_t first, std::size_t end,
                          const std::string& unit) {
  return fmt::format(
      "the reference is inconsistent: values {} to {} are equal by symmetry "
      "but printed as {} to {} {}",
      first + 1, end, rounded(spread.low, 6), rounded(spread.high, 6), unit);
}

}  // namespace

std::vector<Validation> evaluate_validation_row(const std::vector<Comparison>& row,
                                                const std::string& unit) {
  std::vector<Validation> verdicts;
  for (std::size_t first = 0; first < row.size();) {
    const std::size_t end = end_of_repeated(row, first);
    const Spread spread = printed(row, first, end);
    for (std::size_t i = first; i < end; ++i) {
      Validation v = compare(row[i]);
      const double noise = kCoverageFactor * v.u_val;
      const bool between =
          row[i].simulation >= spread.low - noise && row[i].simulation <= spread.high + noise;
      if (v.verdict == ValidationVerdict::beyond_validation_uncertainty && spread.beyond_digits &&
          between) {
        v.verdict = ValidationVerdict::reference_inconsistent;
        v.text = contradiction(spread, first, end, unit);
      } else {
        v.text = describe_validation(v, unit);
      }
      verdicts.push_back(std::move(v));
    }
    first = end;
  }
  return verdicts;
}

std::string to_string(ValidationVerdict verdict) {
  switch (verdict) {
    case ValidationVerdict::within_validation_uncertainty:
      return "within-uncertainty";
    case ValidationVerdict::beyond_validation_uncertainty:
      return "model-error";
    case ValidationVerdict::reference_inconsistent:
      return "reference-inconsistent";
    case ValidationVerdict::undecided:
      break;
  }
  return "undecided";
}

}  // namespace trammel::harness
