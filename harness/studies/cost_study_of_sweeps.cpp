#include <algorithm>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"
#include "harness/judge/sweep.h"
#include "harness/studies/cost_study.h"

namespace trammel::harness {
namespace {

/// Returns the exact values of a quantity, one per entry; empty if no reference is exact.
std::vector<double> exact_values(const TrackedQuantity& tracked) {
  if (tracked.reference == nullptr || !is_exact(*tracked.reference)) return {};
  const references::Reference& reference = *tracked.reference;
  if (reference.unit != unit_of(tracked.quantity)) return {};
  if (tracked.reference_index.empty()) return reference.values;
  std::vector<double> values;
  for (const std::size_t i : tracked.reference_index)
    if (i < reference.values.size()) values.push_back(reference.values[i]);
  return values;
}

/// Returns the checks whose quantities converge under refinement. Checks of counts and checks that
/// only state bounds are omitted.
std::vector<Check> convergence_checks(const Document& document, const std::string& variant,
                                      const std::vector<std::string>& variants) {
  std::vector<Check> checks;
  if (!document.value().contains("checks")) return checks;
  for (const Check& check : read_checks(document, variant, variants)) {
    const bool compared = !check.reference.empty() || !check.against_variant.empty();
    if (!is_count_quantity(check.quantity) && (compared || check.order)) checks.push_back(check);
  }
  return checks;
}

std::vector<ObservedQuantity> observed_quantities(const std::vector<TrackedQuantity>& named) {
  std::vector<ObservedQuantity> observed;
  for (const TrackedQuantity& tracked : named)
    observed.push_back({tracked.quantity, "", tracked.statistic, tracked.index, tracked.is_error,
                        exact_values(tracked)});
  return observed;
}

/// Removes the quantities without exact values if others have exact values, because a cost study
/// measures all errors against the same kind of reference.
bool drop_without_exact_value(std::vector<ObservedQuantity>& observed) {
  const auto lacks = [](const ObservedQuantity& entry) { return entry.needs_reference_solution(); };
  if (std::ranges::all_of(observed, lacks)) return false;
  std::erase_if(observed, lacks);
  return true;
}

std::string quantities_of(const std::vector<ObservedQuantity>& observed) {
  std::vector<std::string> names;
  for (const ObservedQuantity& entry : observed) names.push_back(entry.quantity);
  return join(names, "and");
}

std::vector<std::string> requested_sweeps(const JsonView& sweeps,
                                          const std::vector<std::string>& asked) {
  std::vector<std::string> there;
  for (const auto& entry : sweeps.entries()) there.push_back(entry.first);
  for (const std::string& name : asked) {
    if (contains(there, name)) continue;
    throw sweeps.error(unknown_name_message("the name of a sweep", name, there));
  }
  return asked.empty() ? there : asked;
}

std::vector<Setting> settings_of_sweep(const Document& document, const std::string& sweep,
                                       const std::vector<ObservedQuantity>& observed) {
  const JsonView place = JsonView(document)["sweeps"][sweep];
  std::vector<Setting> settings;
  for (Level& level : sweep_levels(document, sweep))
    settings.push_back({sweep, place.get<std::string>("title", sweep),
                        sweep + " " + shortest_decimal(level.parameter), level.parameter,
                        std::move(level.document), observed});
  return settings;
}

}  // namespace

CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                               const std::vector<std::string>& sweeps,
                               const References& references) {
  const Document document = patched(given, variant);
  const JsonView root(document);
  if (!root.has("sweeps"))
    throw root.error("expected 'sweeps', which define the refinement, or the option --accuracy");
  const std::vector<std::string> wanted = requested_sweeps(root["sweeps"], sweeps);
  CostStudy study = cost_study_without_settings(given, variant);
  const JsonView first = root["sweeps"][wanted.front()];
  std::vector<ObservedQuantity> observed = observed_quantities(
      first.has("quantities")
          ? quantities_of_sweep(first["quantities"], references)
          : quantities_of_checks(document, convergence_checks(document, variant, given.variants()),
                                 references));
  if (observed.empty())
    throw first.error(
        "the sweep has no 'quantities', and no check compares a quantity with a reference");
  const bool exact = drop_without_exact_value(observed);
  study.reference_description = "the exact values of " + quantities_of(observed);
  for (const std::string& name : wanted) {
    for (Setting& setting : settings_of_sweep(document, name, observed))
      study.settings.push_back(std::move(setting));
    if (exact || study.reference_solution) continue;
    study.reference_solution = study.settings.back();
    study.reference_description = "the finest level, " + study.settings.back().title;
  }
  study.outputs.front().scale_description = "relative to each true value";
  return study;
}

}  // namespace trammel::harness
