#pragma once

#include <string>
#include <vector>

/// Every quantity that an analysis can give, with what it means.
namespace trammel::results {

struct QuantityDefinition {
  /// With what it belongs to after the colon, in capitals, as in displacement_x_m:NODE; the last
  /// words of what stands before are the unit.
  std::string name;
  std::vector<std::string> analyses;
  std::string meaning;

  [[nodiscard]] std::string head() const { return name.substr(0, name.find(':')); }
  [[nodiscard]] bool is_of(const std::string& analysis) const;
};

[[nodiscard]] const std::vector<QuantityDefinition>& quantity_definitions();

/// @param name  as results have it, with what it belongs to or without
/// @param analysis  as "statics"; empty: any
/// @returns nullptr where no analysis of that name gives it
[[nodiscard]] const QuantityDefinition* find_quantity_definition(const std::string& name,
                                                                 const std::string& analysis);

}  // namespace trammel::results
