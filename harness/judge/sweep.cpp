#include "harness/judge/sweep.h"

#include <algorithm>

#include "harness/base/find_or_add.h"
#include "harness/base/number.h"
#include "harness/base/quantity.h"
#include "harness/base/statistic.h"

namespace trammel::harness {
namespace {

/// Maximum number of entries of a quantity whose convergence is studied if the case selects no
/// entries.
constexpr std::size_t kMaxTrackedEntries = 16;

void add_other_quantities(const Sweep& sweep, std::vector<TrackedQuantity>& tracked_quantities) {
  for (const auto& item : sweep.levels.back().quantities) {
    if (is_error_measure(item.first)) continue;
    if (!contains(tracked_quantities, item.first, &TrackedQuantity::quantity))
      tracked_quantities.push_back({item.first, "", {}, {}});
  }
}

/// Returns the value of one entry of a quantity on one refinement level, with its round-off error.
std::pair<double, double> level_value(const Quantities& quantities,
                                      const TrackedQuantity& tracked_quantity, std::size_t index) {
  const auto found = quantities.find(tracked_quantity.quantity);
  if (found == quantities.end()) return {kNaN, 0};
  const Quantity& quantity = found->second;
  if (!tracked_quantity.statistic.empty()) {
    std::vector<double> chosen = quantity.values;
    if (!tracked_quantity.index.empty()) {
      chosen.clear();
      for (const std::size_t i : tracked_quantity.index)
        chosen.push_back(i < quantity.values.size() ? quantity.values[i] : kNaN);
    }
    const double roundoff = quantity.roundoff.empty() ? 0 : statistic_of("max", quantity.roundoff);
    return {statistic_of(tracked_quantity.statistic, chosen), roundoff};
  }
  if (index >= quantity.values.size()) return {kNaN, 0};
  return {quantity.values[index], index < quantity.roundoff.size() ? quantity.roundoff[index] : 0};
}

std::vector<std::size_t> entries(const Sweep& sweep, const TrackedQuantity& tracked_quantity) {
  if (!tracked_quantity.statistic.empty()) return {0};
  if (!tracked_quantity.index.empty()) return tracked_quantity.index;
  std::size_t most = 0;
  for (const results::SweepLevel& level : sweep.levels) {
    const auto found = level.quantities.find(tracked_quantity.quantity);
    if (found != level.quantities.end()) most = std::max(most, found->second.values.size());
  }
  std::vector<std::size_t> all(std::min(most, kMaxTrackedEntries));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

results::Number exact_entry_value(const TrackedQuantity& tracked_quantity, std::size_t position) {
  if (tracked_quantity.reference == nullptr ||
      tracked_quantity.reference->unit != unit_of(tracked_quantity.quantity)) {
    return std::nullopt;
  }
  const auto& chosen = tracked_quantity.reference_index;
  if (!chosen.empty() && position >= chosen.size()) return std::nullopt;
  const std::size_t at = chosen.empty() ? position : chosen[position];
  if (at >= tracked_quantity.reference->values.size()) return std::nullopt;
  return tracked_quantity.reference->values[at];
}

Convergence convergence_of_entry(const Sweep& sweep, const JsonView& place,
                                 const TrackedQuantity& tracked_quantity, std::size_t index,
                                 std::size_t position, results::Number element_order) {
  Convergence series;
  series.sweep = sweep.name;
  series.quantity = tracked_quantity.quantity;
  series.statistic = tracked_quantity.statistic;
  series.index = static_cast<int>(index);
  series.theory_order = tracked_quantity.theory;
  if (!series.theory_order && place.has("theory_order"))
    series.theory_order = place.number("theory_order");
  if (place.has("lower_order")) series.lower_order = place.number("lower_order");
  if (element_order) {
    series.theory_order = element_order;
    series.lower_order.reset();
  }
  const std::string measures = place.get<std::string>("refinement_by", "elements");
  for (const results::SweepLevel& level : sweep.levels) {
    const auto [value, roundoff] = level_value(level.quantities, tracked_quantity, index);
    series.parameter.push_back(level.parameter);
    series.size.push_back(element_size(measures, level.parameter));
    series.values.push_back(value);
    series.roundoff.push_back(roundoff);
  }
  series.is_error = tracked_quantity.is_error;
  series.exact = tracked_quantity.is_error ? results::Number(0)
                                           : exact_entry_value(tracked_quantity, position);
  if (series.exact && tracked_quantity.reference) series.reference = tracked_quantity.reference->id;
  return series;
}

bool changes(const Convergence& series) {
  return std::ranges::adjacent_find(series.values, std::not_equal_to()) != series.values.end();
}

}  // namespace

double element_size(const std::string& parameter_meaning, double parameter) {
  if (parameter_meaning == "halvings") return std::exp2(-parameter);
  return parameter_meaning == "size" ? parameter : 1 / parameter;
}

void drop_other_values(Sweep& sweep, const Document& document, const std::vector<Check>& checks) {
  const JsonView place = JsonView(document)["sweeps"][sweep.name];
  const auto is_untracked = [&](const auto& item) {
    if (place.has("quantities")) return !place["quantities"].has(item.first);
    return std::ranges::find(checks, item.first, &Check::quantity) == checks.end();
  };
  for (results::SweepLevel& level : sweep.levels) std::erase_if(level.quantities, is_untracked);
}

std::vector<Convergence> sweep_convergence(const Sweep& sweep, const Document& document,
                                           const std::vector<Check>& checks,
                                           const References& references, TrackedQuantities tracked,
                                           results::Number element_order) {
  const JsonView place = JsonView(document)["sweeps"][sweep.name];
  std::vector<TrackedQuantity> tracked_quantities =
      place.has("quantities") ? quantities_of_sweep(place["quantities"], references)
                              : quantities_of_checks(document, checks, references);
  if (tracked == TrackedQuantities::all) add_other_quantities(sweep, tracked_quantities);
  std::vector<Convergence> found;
  for (const TrackedQuantity& tracked_quantity : tracked_quantities) {
    if (is_count_quantity(tracked_quantity.quantity)) continue;
    const std::vector<std::size_t> chosen = entries(sweep, tracked_quantity);
    for (std::size_t position = 0; position < chosen.size(); ++position) {
      Convergence series = convergence_of_entry(sweep, place, tracked_quantity, chosen[position],
                                                position, element_order);
      // An exact value of zero, such as the frequency of a rigid motion, has no relative error.
      if ((series.exact == 0.0 && !series.is_error) || !changes(series)) continue;
      found.push_back(analyze_convergence(std::move(series)));
    }
  }
  return found;
}

bool is_exact(const references::Reference& reference) {
  return reference.kind == references::ReferenceKind::proved ||
         reference.kind == references::ReferenceKind::exact ||
         reference.kind == references::ReferenceKind::computed;
}

std::vector<TrackedQuantity> quantities_of_sweep(const JsonView& quantities,
                                                 const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  for (const auto& [name, entry] : quantities.entries()) {
    TrackedQuantity tracked_quantity{name, entry.get<std::string>("statistic", ""),
                                     entry.indices("index"), entry.indices("reference_index")};
    tracked_quantity.is_error = entry.get("is_error", false);
    if (entry.has("theory_order")) tracked_quantity.theory = entry.number("theory_order");
    if (entry.has("reference")) tracked_quantity.reference = &references.get(entry["reference"]);
    tracked_quantities.push_back(std::move(tracked_quantity));
  }
  return tracked_quantities;
}

std::vector<TrackedQuantity> quantities_of_checks(const Document& document,
                                                  const std::vector<Check>& checks,
                                                  const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  if (checks.empty()) return tracked_quantities;
  const JsonView places = JsonView(document)["checks"];
  for (const Check& check : checks) {
    TrackedQuantity tracked_quantity{check.quantity, check.statistic, check.index,
                                     check.reference_index};
    if (!check.reference.empty()) {
      const references::Reference& reference = references.get(places[check.name]["reference"]);
      if (is_exact(reference)) tracked_quantity.reference = &reference;
    }
    const auto same = std::ranges::find_if(tracked_quantities, [&](const TrackedQuantity& other) {
      return other.quantity == tracked_quantity.quantity &&
             other.statistic == tracked_quantity.statistic;
    });
    if (same == tracked_quantities.end()) {
      tracked_quantities.push_back(std::move(tracked_quantity));
    } else if (same->reference == nullptr && tracked_quantity.reference != nullptr) {
      *same = std::move(tracked_quantity);
    }
  }
  return tracked_quantities;
}

}  // namespace trammel::harness
