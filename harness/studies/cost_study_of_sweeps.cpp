#include <algorithm>

#include "harness/base/text.h"
#include "harness/input/check.h"
#include "harness/studies/cost_study.h"

namespace trammel::harness {
namespace {

bool is_exact(const references::Reference& reference) {
  return reference.kind == references::ReferenceKind::exact ||
         reference.kind == references::ReferenceKind::computed;
}

/// Exact values of an observed quantity: as many as its entries.
std::vector<double> exact_values(const references::Reference& reference,
                                 const ObservedQuantity& observed,
                                 const std::vector<std::size_t>& chosen) {
  if (!is_exact(reference) || reference.unit != unit_of(observed.quantity)) return {};
  if (chosen.empty()) return reference.values;
  std::vector<double> values;
  for (const std::size_t i : chosen) {
    if (i < reference.values.size()) values.push_back(reference.values[i]);
  }
  return values;
}

std::vector<ObservedQuantity> named_by_sweep(const JsonView& quantities,
                                             const References& references) {
  std::vector<ObservedQuantity> observed;
  for (const auto& [name, place] : quantities.entries()) {
    ObservedQuantity entry;
    entry.quantity = name;
    entry.statistic = place.get<std::string>("statistic", "");
    entry.index = indices(place, "index");
    entry.is_error = place.get("is_error", false);
    if (place.has("reference")) {
      entry.exact = exact_values(references.get(place["reference"]), entry,
                                 indices(place, "reference_index"));
    }
    observed.push_back(std::move(entry));
  }
  return observed;
}

/// What the checks look at, each once; counts and what is only bounded left out. A check with true
/// values counts before one without.
std::vector<ObservedQuantity> named_by_checks(const Document& document, const std::string& variant,
                                              const std::vector<std::string>& variants,
                                              const References& references) {
  std::vector<ObservedQuantity> observed;
  if (!document.value().contains("checks")) return observed;
  const JsonView places = JsonView(document)["checks"];
  for (const Check& check : read_checks(document, variant, variants)) {
    const bool compared = !check.reference.empty() || !check.against_variant.empty();
    if (is_count(check.quantity) || !(compared || check.order)) continue;
    ObservedQuantity entry;
    entry.quantity = check.quantity;
    entry.statistic = check.statistic;
    entry.index = check.index;
    if (!check.reference.empty()) {
      entry.exact = exact_values(references.get(places[check.name]["reference"]), entry,
                                 check.reference_index);
    }
    const auto same =
        std::find_if(observed.begin(), observed.end(), [&](const ObservedQuantity& other) {
          return other.quantity == entry.quantity && other.statistic == entry.statistic;
        });
    if (same == observed.end()) {
      observed.push_back(std::move(entry));
    } else if (same->exact.empty() && !entry.exact.empty()) {
      *same = std::move(entry);
    }
  }
  return observed;
}

/// Only what has exact values, where anything has: an error is measured one way.
bool keep_exact(std::vector<ObservedQuantity>& observed) {
  const auto lacks = [](const ObservedQuantity& entry) { return entry.needs_reference_solution(); };
  if (std::all_of(observed.begin(), observed.end(), lacks)) return false;
  observed.erase(std::remove_if(observed.begin(), observed.end(), lacks), observed.end());
  return true;
}

std::string quantities_of(const std::vector<ObservedQuantity>& observed) {
  std::vector<std::string> names;
  for (const ObservedQuantity& entry : observed) names.push_back(entry.quantity);
  return join(names, "and");
}

}  // namespace

CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                               const std::vector<std::string>& sweeps,
                               const References& references) {
  const Document document = patched(given, variant);
  const JsonView root(document);
  if (!root.has("sweeps")) throw root.error("expected 'sweeps', which say what to refine");
  std::vector<std::string> there;
  for (const auto& entry : root["sweeps"].entries()) there.push_back(entry.first);
  for (const std::string& name : sweeps) {
    if (std::find(there.begin(), there.end(), name) != there.end()) continue;
    throw root["sweeps"].error("expected the name of a sweep (got '" + printable(name) + "')" +
                               did_you_mean(name, there));
  }
  CostStudy study;
  study.id = given.id() + (variant == kBaseVariant ? "" : "-" + variant);
  study.family = given.document.value().value("family", given.id());
  study.title = given.title();
  if (variant != kBaseVariant) study.title += ": " + given.variant_title(variant);
  const std::vector<std::string>& wanted = sweeps.empty() ? there : sweeps;
  const JsonView first = root["sweeps"][wanted.front()];
  std::vector<ObservedQuantity> observed =
      first.has("quantities") ? named_by_sweep(first["quantities"], references)
                              : named_by_checks(document, variant, given.variants(), references);
  if (observed.empty()) {
    throw first.error("expected 'quantities', or checks, which say what to measure");
  }
  const bool exact = keep_exact(observed);
  for (const std::string& name : wanted) {
    const JsonView place = root["sweeps"][name];
    for (Level& level : levels(document, name)) {
      Setting setting;
      setting.curve = name;
      setting.curve_title = place.get<std::string>("title", name);
      setting.title = name + " " + shortest(level.parameter);
      setting.value = level.parameter;
      setting.document = std::move(level.document);
      setting.observed = observed;
      study.settings.push_back(std::move(setting));
    }
  }
  study.reference_description = "the exact values of " + quantities_of(observed);
  if (!exact) {
    const auto finest =
        std::find_if(study.settings.rbegin(), study.settings.rend(),
                     [&](const Setting& setting) { return setting.curve == wanted.front(); });
    study.reference_solution = *finest;
    study.reference_description = "the finest level, " + finest->title;
  }
  study.scale_description = "relative to each true value";
  return study;
}

}  // namespace trammel::harness
