#pragma once

#include <map>
#include <string>
#include <vector>

namespace trammel::harness {

/// Numbers recorded under one name. The name ends with the unit, a colon and the part of the model
/// to which the numbers belong: displacement_x_m:P.
struct Quantity {
  std::vector<double> values;
  /// Relative round-off error of each value; empty if it is unknown.
  std::vector<double> roundoff;
};

using Quantities = std::map<std::string, Quantity>;

/// Name of a quantity without unit and part of the model, and the unit: "reaction_moment_N_m:A1" is
/// "reaction_moment" in "N m". The unit of a dimensionless quantity is "1".
struct NameAndUnit {
  std::string name, unit;
};
[[nodiscard]] NameAndUnit split_name(const std::string& name);

/// Returns the unit in a quantity's name, in the form used by references: "frequency_Hz" -> "Hz",
/// "reaction_moment_N_m:A1" -> "N m", "parallel_singularity_distance" -> "1".
[[nodiscard]] std::string unit_of(const std::string& name);

/// Returns true if a quantity is a count, which has no order of convergence.
[[nodiscard]] bool is_count_quantity(const std::string& name);

/// Returns true if a quantity is an error measure (round-off, residual). Under mesh refinement,
/// such a quantity does not converge to a limit.
[[nodiscard]] bool is_error_measure(const std::string& name);

}  // namespace trammel::harness
