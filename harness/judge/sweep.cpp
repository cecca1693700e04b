#include "harness/judge/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/diagnostic.h"
#include "harness/base/numbers.h"
#include "harness/base/statistic.h"
#include "harness/input/case.h"
#include "harness/judge/evaluate_check.h"

namespace trammel::harness {
namespace {

/// Entries of an array that are followed when nobody says which.
constexpr std::size_t kMaxTrackedEntries = 16;

/// A quantity to follow, and where its exact values stand.
struct TrackedQuantity {
  std::string quantity, statistic;
  std::vector<std::size_t> index, reference_index;
  const references::Reference* reference = nullptr;
  bool is_error = false;
  std::optional<double> theory = std::nullopt;
};

std::vector<std::size_t> indices(const JsonView& place, const char* key) {
  const auto stated = place.find(key);
  if (!stated) return {};
  if (stated->json().is_array()) return stated->get<std::vector<std::size_t>>();
  return {stated->get<std::size_t>()};
}

bool is_exact(const references::Reference& reference) {
  return reference.kind == references::ReferenceKind::exact ||
         reference.kind == references::ReferenceKind::computed;
}

std::vector<TrackedQuantity> named_by_sweep(const JsonView& place, const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  for (const auto& [name, entry] : place.entries()) {
    TrackedQuantity tracked_quantity{name, entry.get<std::string>("statistic", ""),
                                     indices(entry, "index"), indices(entry, "reference_index"),
                                     nullptr};
    tracked_quantity.is_error = entry.get("is_error", false);
    if (entry.has("theory_order")) tracked_quantity.theory = entry.number("theory_order");
    if (entry.has("reference")) tracked_quantity.reference = &references.get(entry["reference"]);
    tracked_quantities.push_back(std::move(tracked_quantity));
  }
  return tracked_quantities;
}

/// What the checks look at, each once; a check with true values before one without.
std::vector<TrackedQuantity> named_by_checks(const Document& document,
                                             const std::vector<Check>& checks,
                                             const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  const JsonView places = JsonView(document)["checks"];
  for (const Check& check : checks) {
    TrackedQuantity tracked_quantity{check.quantity, check.statistic, check.index,
                                     check.reference_index, nullptr};
    if (!check.reference.empty()) {
      const references::Reference& reference = references.get(places[check.name]["reference"]);
      if (is_exact(reference)) tracked_quantity.reference = &reference;
    }
    const auto same = std::find_if(tracked_quantities.begin(), tracked_quantities.end(),
                                   [&](const TrackedQuantity& other) {
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

void add_everything_else(const Sweep& sweep, std::vector<TrackedQuantity>& tracked_quantities) {
  for (const auto& item : sweep.levels.back().result.quantities) {
    if (is_diagnostic(item.first)) continue;
    const bool known = std::any_of(tracked_quantities.begin(), tracked_quantities.end(),
                                   [&](const TrackedQuantity& tracked_quantity) {
                                     return tracked_quantity.quantity == item.first;
                                   });
    if (!known) tracked_quantities.push_back({item.first, "", {}, {}, nullptr});
  }
}

double size_of(const std::string& measures, double parameter) {
  if (measures == "halvings") return std::exp2(-parameter);
  return measures == "size" ? parameter : 1 / parameter;
}

/// The value (and its round-off) that a level has for one entry.
std::pair<double, double> entry_of(const AnalysisResult& result,
                                   const TrackedQuantity& tracked_quantity, std::size_t index) {
  const auto found = result.quantities.find(tracked_quantity.quantity);
  if (found == result.quantities.end()) return {kNaN, 0};
  const Quantity& quantity = found->second;
  if (!tracked_quantity.statistic.empty()) {
    std::vector<double> chosen = quantity.values;
    if (!tracked_quantity.index.empty()) {
      chosen.clear();
      for (const std::size_t i : tracked_quantity.index) {
        chosen.push_back(i < quantity.values.size() ? quantity.values[i] : kNaN);
      }
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
  for (const SweepLevel& level : sweep.levels) {
    const auto found = level.result.quantities.find(tracked_quantity.quantity);
    if (found != level.result.quantities.end()) most = std::max(most, found->second.values.size());
  }
  std::vector<std::size_t> all(std::min(most, kMaxTrackedEntries));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

std::optional<double> exact_of(const TrackedQuantity& tracked_quantity, std::size_t position) {
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

Series track_entry(const Sweep& sweep, const JsonView& place,
                   const TrackedQuantity& tracked_quantity, std::size_t index,
                   std::size_t position) {
  Series series;
  series.sweep = sweep.name;
  series.quantity = tracked_quantity.quantity;
  series.statistic = tracked_quantity.statistic;
  series.index = index;
  series.theory = tracked_quantity.theory;
  if (!series.theory && place.has("theory_order")) series.theory = place.number("theory_order");
  if (place.has("lower_order")) series.lower = place.number("lower_order");
  const std::string measures = place.get<std::string>("refinement_by", "elements");
  for (const SweepLevel& level : sweep.levels) {
    const auto [value, roundoff] = entry_of(level.result, tracked_quantity, index);
    series.parameter.push_back(level.parameter);
    series.size.push_back(size_of(measures, level.parameter));
    series.values.push_back(value);
    series.roundoff.push_back(roundoff);
  }
  series.is_error = tracked_quantity.is_error;
  series.exact = tracked_quantity.is_error ? 0.0 : exact_of(tracked_quantity, position);
  if (series.exact && tracked_quantity.reference) series.reference = tracked_quantity.reference->id;
  return series;
}

bool changes(const Series& series) {
  return std::adjacent_find(series.values.begin(), series.values.end(), [](double a, double b) {
           return a != b && !(std::isnan(a) && std::isnan(b));
         }) != series.values.end();
}

/// From coarse to fine; a size of zero or less has no meaning.
void check_levels(const JsonView& place, const std::vector<Level>& levels) {
  const std::string measures = place.get<std::string>("refinement_by", "elements");
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double size = size_of(measures, levels[i].parameter);
    if (!(size > 0) || !(size < before) || !std::isfinite(size)) {
      throw place["values"][i].error("expected values from coarse to fine (got " +
                                     std::to_string(levels[i].parameter) + ")");
    }
    before = size;
  }
}

}  // namespace

std::vector<Sweep> run_sweeps(const Document& document, const References& references) {
  std::vector<Sweep> sweeps;
  const auto places = JsonView(document).find("sweeps");
  if (!places) return sweeps;
  for (const auto& [name, place] : places->entries()) {
    Sweep sweep{name, {}};
    const std::vector<Level> found = levels(document, name);
    check_levels(place, found);
    for (const Level& level : found) {
      sweep.levels.push_back({level.parameter, analyse(level.document, references, {false})});
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

std::vector<Convergence> study_sweep(const Sweep& sweep, const Document& document,
                                     const std::vector<Check>& checks, const References& references,
                                     TrackedQuantities tracked) {
  const JsonView place = JsonView(document)["sweeps"][sweep.name];
  std::vector<TrackedQuantity> tracked_quantities =
      place.has("quantities")               ? named_by_sweep(place["quantities"], references)
      : document.value().contains("checks") ? named_by_checks(document, checks, references)
                                            : std::vector<TrackedQuantity>{};
  if (tracked == TrackedQuantities::all) add_everything_else(sweep, tracked_quantities);
  std::vector<Convergence> found;
  for (const TrackedQuantity& tracked_quantity : tracked_quantities) {
    if (is_count(tracked_quantity.quantity)) continue;
    const std::vector<std::size_t> chosen = entries(sweep, tracked_quantity);
    for (std::size_t position = 0; position < chosen.size(); ++position) {
      const Series series = track_entry(sweep, place, tracked_quantity, chosen[position], position);
      // A zero (a rigid motion) has no relative error.
      if ((series.exact == 0.0 && !series.is_error) || !changes(series)) continue;
      found.push_back(analyse_convergence(series));
    }
  }
  return found;
}

}  // namespace trammel::harness
