#include "harness/judge/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/input/case.h"
#include "harness/base/diagnostic.h"
#include "harness/judge/judge.h"
#include "harness/base/statistic.h"

namespace trammel {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// Entries of an array that are followed when nobody says which.
constexpr std::size_t most_entries = 16;

/// A quantity to follow, and where its exact values stand.
struct Followed {
  std::string quantity, statistic;
  std::vector<std::size_t> index, reference_index;
  const Reference* reference = nullptr;
  bool is_error = false;
  std::optional<double> theory = std::nullopt;
};

std::vector<std::size_t> indices(const Cursor& place, const char* key) {
  const auto stated = place.find(key);
  if (!stated) return {};
  if (stated->json().is_array()) return stated->get<std::vector<std::size_t>>();
  return {stated->get<std::size_t>()};
}

bool is_truth(const Reference& reference) {
  return reference.kind == ReferenceKind::exact || reference.kind == ReferenceKind::computed;
}

std::vector<Followed> named_by_sweep(const Cursor& place, const References& references) {
  std::vector<Followed> followed;
  for (const auto& [name, entry] : place.entries()) {
    Followed one{name, entry.get<std::string>("statistic", ""), indices(entry, "index"),
                 indices(entry, "reference_index"), nullptr};
    one.is_error = entry.get("is_error", false);
    if (entry.has("theory_order")) one.theory = entry.number("theory_order");
    if (entry.has("reference")) one.reference = &references.get(entry["reference"]);
    followed.push_back(std::move(one));
  }
  return followed;
}

/// What the checks look at, each once; a check with true values before one without.
std::vector<Followed> named_by_checks(const Document& document, const std::vector<Check>& checks,
                                      const References& references) {
  std::vector<Followed> followed;
  const Cursor places = Cursor(document)["checks"];
  for (const Check& check : checks) {
    Followed one{check.quantity, check.statistic, check.index, check.reference_index, nullptr};
    if (!check.reference.empty()) {
      const Reference& reference = references.get(places[check.name]["reference"]);
      if (is_truth(reference)) one.reference = &reference;
    }
    const auto same = std::find_if(followed.begin(), followed.end(), [&](const Followed& other) {
      return other.quantity == one.quantity && other.statistic == one.statistic;
    });
    if (same == followed.end()) {
      followed.push_back(std::move(one));
    } else if (same->reference == nullptr && one.reference != nullptr) {
      *same = std::move(one);
    }
  }
  return followed;
}

void add_everything_else(const Sweep& sweep, std::vector<Followed>& followed) {
  for (const auto& item : sweep.levels.back().result.quantities) {
    if (is_diagnostic(item.first)) continue;
    const bool known = std::any_of(followed.begin(), followed.end(),
                                   [&](const Followed& one) { return one.quantity == item.first; });
    if (!known) followed.push_back({item.first, "", {}, {}, nullptr});
  }
}

double size_of(const std::string& measures, double parameter) {
  if (measures == "halvings") return std::exp2(-parameter);
  return measures == "size" ? parameter : 1 / parameter;
}

/// The value (and its round-off) that a level has for one entry.
std::pair<double, double> entry_of(const AnalysisResult& result, const Followed& followed,
                                   std::size_t index) {
  const auto found = result.quantities.find(followed.quantity);
  if (found == result.quantities.end()) return {nothing, 0};
  const Quantity& quantity = found->second;
  if (!followed.statistic.empty()) {
    std::vector<double> chosen = quantity.values;
    if (!followed.index.empty()) {
      chosen.clear();
      for (const std::size_t i : followed.index) {
        chosen.push_back(i < quantity.values.size() ? quantity.values[i] : nothing);
      }
    }
    const double roundoff = quantity.roundoff.empty() ? 0 : statistic_of("max", quantity.roundoff);
    return {statistic_of(followed.statistic, chosen), roundoff};
  }
  if (index >= quantity.values.size()) return {nothing, 0};
  return {quantity.values[index], index < quantity.roundoff.size() ? quantity.roundoff[index] : 0};
}

std::vector<std::size_t> entries(const Sweep& sweep, const Followed& followed) {
  if (!followed.statistic.empty()) return {0};
  if (!followed.index.empty()) return followed.index;
  std::size_t most = 0;
  for (const SweepLevel& level : sweep.levels) {
    const auto found = level.result.quantities.find(followed.quantity);
    if (found != level.result.quantities.end()) most = std::max(most, found->second.values.size());
  }
  std::vector<std::size_t> all(std::min(most, most_entries));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

std::optional<double> exact_of(const Followed& followed, std::size_t position) {
  if (followed.reference == nullptr || followed.reference->unit != unit_of(followed.quantity)) {
    return std::nullopt;
  }
  const auto& chosen = followed.reference_index;
  if (!chosen.empty() && position >= chosen.size()) return std::nullopt;
  const std::size_t at = chosen.empty() ? position : chosen[position];
  if (at >= followed.reference->values.size()) return std::nullopt;
  return followed.reference->values[at];
}

Series follow_entry(const Sweep& sweep, const Cursor& place, const Followed& followed,
                    std::size_t index, std::size_t position) {
  Series series;
  series.sweep = sweep.name;
  series.quantity = followed.quantity;
  series.statistic = followed.statistic;
  series.index = index;
  series.theory = followed.theory;
  if (!series.theory && place.has("theory_order")) series.theory = place.number("theory_order");
  if (place.has("lower_order")) series.lower = place.number("lower_order");
  const std::string measures = place.get<std::string>("measures", "elements");
  for (const SweepLevel& level : sweep.levels) {
    const auto [value, roundoff] = entry_of(level.result, followed, index);
    series.parameter.push_back(level.parameter);
    series.size.push_back(size_of(measures, level.parameter));
    series.values.push_back(value);
    series.roundoff.push_back(roundoff);
  }
  series.is_error = followed.is_error;
  series.exact = followed.is_error ? 0.0 : exact_of(followed, position);
  if (series.exact && followed.reference) series.reference = followed.reference->id;
  return series;
}

bool changes(const Series& series) {
  return std::adjacent_find(series.values.begin(), series.values.end(), [](double a, double b) {
           return a != b && !(std::isnan(a) && std::isnan(b));
         }) != series.values.end();
}

/// From coarse to fine; a size of zero or less has no meaning.
void check_levels(const Cursor& place, const std::vector<Level>& levels) {
  const std::string measures = place.get<std::string>("measures", "elements");
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
  const auto places = Cursor(document).find("sweeps");
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
                                     Follow follow) {
  const Cursor place = Cursor(document)["sweeps"][sweep.name];
  std::vector<Followed> followed =
      place.has("quantities")               ? named_by_sweep(place["quantities"], references)
      : document.value().contains("checks") ? named_by_checks(document, checks, references)
                                            : std::vector<Followed>{};
  if (follow == Follow::all) add_everything_else(sweep, followed);
  std::vector<Convergence> found;
  for (const Followed& one : followed) {
    if (is_count(one.quantity)) continue;
    const std::vector<std::size_t> chosen = entries(sweep, one);
    for (std::size_t position = 0; position < chosen.size(); ++position) {
      const Series series = follow_entry(sweep, place, one, chosen[position], position);
      // A zero (a rigid motion) has no relative error.
      if ((series.exact == 0.0 && !series.is_error) || !changes(series)) continue;
      found.push_back(study(series));
    }
  }
  return found;
}

}  // namespace trammel
