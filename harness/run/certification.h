#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"

/// Sensitivity of verdicts and numbers to conditions that should not matter: rounding, compiler,
/// optimization.
namespace trammel::harness {

/// Results of the same cases under other conditions, such as another rounding mode or compiler.
struct Configuration {
  std::string name;
  results::Results results;
};

struct ConfigurationRow {
  std::string name;
  std::size_t checks = 0, missing = 0;  ///< judged in both configurations; judged in only one
  /// Digits of a judged number that agree with the first configuration.
  double fewest_digits = 16, median_digits = 16;
  std::string least_certain;  ///< number with the fewest equal digits
};

/// A verdict of a check "case:variant name[index]", or the status of a run "case:variant", that is
/// missing or differs from the first configuration. Also a status without an answer in any
/// configuration, with its reason.
struct VerdictFlip {
  std::string configuration, check, from, to;
};

/// A tolerance less than ten times the variation of the difference between configurations.
struct TightTolerance {
  std::string check, configuration;  ///< "case:variant name" of the check, for its worst entry
  /// Tolerance, and variation between configurations, in the measure of the check.
  double tolerance = 0, noise = 0;
};

struct Certification {
  std::vector<ConfigurationRow> rows;
  std::vector<VerdictFlip> flips;
  std::vector<TightTolerance> tight;  ///< tightest first
};

/// Compares every judged entry of the first configuration with the other configurations.
[[nodiscard]] Certification certify(const std::vector<Configuration>& configurations);

}  // namespace trammel::harness
