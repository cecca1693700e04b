#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"

/// How much verdicts and numbers depend on what should not matter: rounding, compiler,
/// optimization.
namespace trammel::harness {

/// The same cases, computed with one thing changed.
struct Configuration {
  std::string name;
  results::Results results;
};

struct ConfigurationRow {
  std::string name;
  std::size_t checks = 0, missing = 0;            ///< judged in both; judged in one alone
  double fewest_digits = 16, median_digits = 16;  ///< of a judged number that agree with the first
  std::string least_certain;                      ///< where they are fewest
};

/// A verdict of a check "case:variant name[index]", or the status of a run "case:variant", that is
/// not that of the first configuration, or missing; and a status without an answer in any of them,
/// with its reason.
struct VerdictFlip {
  std::string configuration, check, from, to;
};

/// A tolerance less than ten times what the configurations make of the difference.
struct TightTolerance {
  std::string check, configuration;  ///< check: "case:variant name", its worst entry
  double tolerance = 0, noise = 0;   ///< in the measure of the check
};

struct Certification {
  std::vector<ConfigurationRow> rows;
  std::vector<VerdictFlip> flips;
  std::vector<TightTolerance> tight;  ///< the tightest first
};

/// Every judged entry of the first configuration beside the others'.
[[nodiscard]] Certification certify(const std::vector<Configuration>& configurations);

}  // namespace trammel::harness
