#pragma once

#include <string>
#include <vector>

/// Definitions of every quantity that an analysis can compute.
namespace trammel::results {

struct QuantityDefinition {
  /// Name of the quantity with its unit at the end, then a colon and the type of object to which
  /// the quantity belongs, in capitals: displacement_x_m:NODE.
  std::string name;
  std::vector<std::string> analyses;
  std::string meaning;

  [[nodiscard]] std::string base_name() const { return name.substr(0, name.find(':')); }
  [[nodiscard]] bool belongs_to_analysis(const std::string& analysis) const;
};

[[nodiscard]] const std::vector<QuantityDefinition>& quantity_definitions();

/// Finds the definition of a quantity.
/// @param name  name of a computed quantity, with or without the object after the colon.
/// @param analysis  analysis that computes the quantity, such as "statics"; empty: any analysis.
/// @returns nullptr if no such analysis computes the quantity.
[[nodiscard]] const QuantityDefinition* find_quantity_definition(const std::string& name,
                                                                 const std::string& analysis);

}  // namespace trammel::results
