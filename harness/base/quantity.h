#pragma once

#include <map>
#include <string>
#include <vector>

namespace trammel::harness {

/// Numbers under one name. The name carries the unit as its last words, and what it belongs to
/// after a colon: displacement_x_m:P.
struct Quantity {
  std::vector<double> values;
  /// Relative round-off error of each value as far as it is known; empty where it is not.
  std::vector<double> roundoff;
};

using Quantities = std::map<std::string, Quantity>;

/// A quantity's name without what it belongs to, and its unit apart: "reaction_moment_N_m:A1" is
/// "reaction_moment" in "N m". What has no unit is in "1".
struct NameAndUnit {
  std::string name, unit;
};
[[nodiscard]] NameAndUnit split_unit(const std::string& name);

/// The unit in a quantity's name, as references write it: "frequency_Hz" -> "Hz",
/// "reaction_moment_N_m:A1" -> "N m", "parallel_singularity_distance" -> "1".
[[nodiscard]] std::string unit_of(const std::string& name);

/// Whether a quantity counts things, so that it has no order of convergence.
[[nodiscard]] bool is_count(const std::string& name);

/// Whether a quantity says how well others were computed (round-off, residuals): smaller is better,
/// and nothing converges to its limit.
[[nodiscard]] bool is_diagnostic(const std::string& name);

}  // namespace trammel::harness
