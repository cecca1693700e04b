#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"

/// Certification: sensitivity of verdicts and numbers to conditions that should not influence them,
/// such as rounding mode, compiler and optimization.
namespace trammel::harness {

/// Results of the same cases under other conditions, such as another rounding mode or compiler.
struct Configuration {
  std::string name;
  results::Results results;
};

struct ConfigurationRow {
  std::string name;
  /// Number of checks judged in the first and in this configuration, and number of checks judged in
  /// only one of these two.
  std::size_t checks = 0, missing = 0;
  /// Numbers of digits that agree with the first configuration: minimum and median over all judged
  /// numbers.
  double fewest_digits = 16, median_digits = 16;
  std::string least_certain;  ///< name of the number with the fewest equal digits
};

/// Verdict of a check ("case:variant name[index]") or status of a run ("case:variant") that is
/// missing in one configuration, or differs from the first configuration. A status without an
/// answer, such as a crash, is also listed, with its reason.
struct VerdictFlip {
  std::string configuration, check, from, to;
};

/// Tolerance of a check that is less than ten times the noise. The noise is the change of the
/// judged difference between two configurations.
struct TightTolerance {
  std::string check, configuration;  ///< check: "case:variant name"
  /// Tolerance, and change of the judged difference from the first to another configuration.
  double tolerance = 0, noise = 0;
};

struct Certification {
  std::vector<ConfigurationRow> rows;
  std::vector<VerdictFlip> flips;
  std::vector<TightTolerance> tight;  ///< smallest ratio of tolerance to noise first
};

/// Compares judged numbers and verdicts of the first configuration with all other configurations.
[[nodiscard]] Certification certify(const std::vector<Configuration>& configurations);

}  // namespace trammel::harness
