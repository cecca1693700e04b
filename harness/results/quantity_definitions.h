#pragma once

#include <string>
#include <vector>

/// Definitions of every quantity that an analysis can compute.
namespace trammel::results {

struct QuantityDefinition {
  /// Name, followed by a colon and its kind of part in capitals: displacement_x_m:NODE. The last
  /// words before the colon are the unit.
  std::string name;
  std::vector<std::string> analyses;
  std::string meaning;

  [[nodiscard]] std::string head() const { return name.substr(0, name.find(':')); }
  [[nodiscard]] bool is_of(const std::string& analysis) const;
};

[[nodiscard]] const std::vector<QuantityDefinition>& quantity_definitions();

/// Finds a definition.
/// @param name  name of a result, with or without its part.
/// @param analysis  such as "statics"; empty: any.
/// @returns nullptr if no such analysis computes it.
[[nodiscard]] const QuantityDefinition* find_quantity_definition(const std::string& name,
                                                                 const std::string& analysis);

}  // namespace trammel::results
