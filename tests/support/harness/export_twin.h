#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/export/exported_case.h"
#include "tests/support/harness/support.h"

/// Compares the results of an exported case file with the results of the original case.
namespace trammel::testing {

struct ExportTwin {
  std::string name;
  std::string refused = {};  ///< error message without the JSON pointer
  Json json = {};            ///< the exported case
  AnalysisResult exported = {};
  double difference = 0;  ///< largest difference relative to the values of the same quantity
  std::string worst = {};
};

/// Returns all models of a case that can be exported: the variant itself, and the variant with each
/// parameter value of its sweeps.
inline std::vector<ExportChoice> exportable_choices(const Case& given, const std::string& variant) {
  std::vector<ExportChoice> choices = {{variant}};
  const Document document = patched(given, variant);
  if (const auto sweeps = JsonView(document).find("sweeps"))
    for (const auto& [name, sweep] : sweeps->entries())
      for (std::size_t k = 0; k < sweep["values"].size(); ++k)
        choices.push_back({variant, name, k});
  return choices;
}

/// Returns true for estimates of round-off and for quantities that depend on round-off. The time of
/// a peak depends on round-off if several samples are almost equal.
inline bool is_roundoff_quantity(const std::string& name) {
  const auto has = [&](const char* word) { return contains(name, word); };
  return has("roundoff") || has("_residual") || has("energy_drift") || has("newton_") ||
         has("estimated_correct_digits") || has("peak_time_s");
}

/// Returns true for quantities of edges and of tapered members, which do not exist in an exported
/// case.
inline bool has_no_exported_counterpart(const std::string& name, const Json& model) {
  std::string item = name.substr(std::min(name.size(), name.find(':') + 1));
  if (model.contains("edges") && model.at("edges").contains(item)) return true;
  item = item.substr(0, item.find('.'));
  return model.contains("members") && model.at("members").contains(item) &&
         model.at("members").at(item).contains("end_section");
}

/// Returns the scale to which differences of a quantity are relative: the largest magnitude among
/// the quantities with the same name before the colon. The x and y components of a vector have a
/// common scale.
inline double scale_of_quantity(const Quantities& all, const std::string& name) {
  const auto head = [](const std::string& text) {
    const std::string quantity = text.substr(0, text.find(':'));
    const std::size_t axis = std::min(quantity.find("_x_"), quantity.find("_y_"));
    return axis == std::string::npos ? quantity : std::string(quantity).replace(axis, 3, "_");
  };
  double largest = 0;
  for (const auto& [other, quantity] : all) {
    if (head(other) != head(name)) continue;
    for (const double value : quantity.values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

inline void compare(const Quantities& own, const Json& model, ExportTwin& twin) {
  for (const auto& [name, quantity] : own) {
    if (is_roundoff_quantity(name) || has_no_exported_counterpart(name, model)) continue;
    if (name.rfind("effect_", 0) == 0) continue;  // the exported case has the selected effects
    const auto found = twin.exported.quantities.find(name);
    const bool there = found != twin.exported.quantities.end() &&
                       found->second.values.size() == quantity.values.size();
    double difference = there ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; there && i < quantity.values.size(); ++i) {
      const double a = quantity.values[i], b = found->second.values[i];
      if (a == b || (std::isnan(a) && std::isnan(b))) continue;
      difference = std::max(difference, std::abs(a - b) / scale_of_quantity(own, name));
    }
    if (difference <= twin.difference) continue;
    twin.difference = difference;
    twin.worst = name;
  }
}

/// Exports a case to a file, and computes the case and the exported case.
inline ExportTwin export_and_compute_both(const Case& given, const ExportChoice& choice) {
  ExportTwin twin{given.id() + ":" + choice.variant};
  if (choice.level) twin.name += " " + choice.sweep + " " + std::to_string(*choice.level);
  try {
    twin.json = export_case(given, choice);
  } catch (const InputError& error) {
    const std::string text = error.what();
    twin.refused = text.substr(text.find(": ", text.find(": ") + 1) + 2);
    return twin;
  }
  const Folder folder;
  const References references;
  const Document document = case_with_chosen_patches(given, choice);
  const AnalysisResult own = analyze(document, references, {false});
  const Case written = load_case(folder.write("exported.json", twin.json.dump()));
  twin.exported = analyze(patched(written, "base"), references, {false});
  if (own.outcome.status != twin.exported.outcome.status) {
    twin.difference = std::numeric_limits<double>::infinity();
    twin.worst = twin.exported.outcome.reason;
  }
  compare(own.quantities, document.value().value("model", Json::object()), twin);
  return twin;
}

}  // namespace trammel::testing
