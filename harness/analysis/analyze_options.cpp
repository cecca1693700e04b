#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "harness/analysis/analysis.h"
#include "harness/analysis/analyze_study.h"
#include "harness/base/statistic.h"
#include "harness/input/case.h"
#include "harness/input/catalogue.h"

namespace trammel::harness {
namespace {

/// Recorded quantities by name: the number of computations with each outcome, such as "solved", and
/// the largest difference between results with different options.
using OptionCounts = std::map<std::string, double>;

OptionCounts zero_option_counts() {
  return {{"attempted", 0}, {"solved", 0},     {"singular", 0},   {"not_converged", 0},
          {"refused", 0},   {"not_finite", 0}, {"unexplained", 0}};
}

/// Name of a quantity: the largest difference between results that must not depend on the options,
/// relative to the sum of the round-off bounds of both results.
constexpr const char* kDifference = "result_difference_over_roundoff";

void record_difference(double by, OptionCounts& counts) {
  double& largest = counts[kDifference];
  largest = std::max(largest, by);
}

/// Combinations of options that are tested for one analysis.
struct Options {
  std::vector<Json> combinations;  ///< one JSON object of options per combination
  bool must_agree = false;         ///< true if all combinations must yield equal results
  /// Words that the reason of the outcome must contain if a computation does not converge.
  std::vector<std::string> required_terms;
};

/// Returns all combinations of the option values under the key "vary". Each combination also
/// contains the options under the key "set".
std::vector<Json> option_combinations(const JsonView& place) {
  std::vector<Json> found = {place.has("set") ? place["set"].json() : Json::object()};
  if (!place.has("vary")) return found;
  for (const auto& [option, values] : place["vary"].entries()) {
    std::vector<Json> more;
    for (const Json& added : found)
      for (const Json& value : values.json()) {
        more.push_back(added);
        more.back()[option] = value;
      }
    found = std::move(more);
  }
  return found;
}

Options options_of_analysis(const JsonView& place, const std::string& kind) {
  Options options{{Json::object()}, false, {}};
  const auto own = place["analyses"].find(kind);
  if (!own) return options;
  options.combinations = option_combinations(*own);
  options.must_agree = own->get("same_results", false);
  options.required_terms = own->get("reason_contains", std::vector<std::string>{});
  return options;
}

/// Returns the largest difference of a quantity between two results, relative to the sum of its two
/// round-off bounds. Quantities without a round-off bound are skipped.
double max_relative_difference(const Quantities& a, const Quantities& b) {
  double largest = 0;
  for (const auto& [name, added] : a) {
    const auto other = b.find(name);
    if (other == b.end() || added.roundoff.size() != added.values.size()) continue;
    const std::vector<double>& roundoff = other->second.roundoff;
    const auto allowed = [&, &added = added](std::size_t i) {
      return std::abs(added.values[i]) *
             (added.roundoff[i] + (i < roundoff.size() ? roundoff[i] : added.roundoff[i]));
    };
    largest =
        std::max(largest, largest_difference(added.values, other->second.values, allowed).value);
  }
  return largest;
}

bool all_finite(const Quantities& quantities) {
  return std::ranges::all_of(quantities, [](const auto& item) {
    return std::ranges::all_of(item.second.values, [](double x) { return std::isfinite(x); });
  });
}

bool contains_all_terms(const std::string& reason, const std::vector<std::string>& required_terms) {
  return !reason.empty() && std::ranges::all_of(required_terms, [&](const std::string& word) {
    return reason.find(word) != std::string::npos;
  });
}

void count(const AnalysisResult& result, const std::vector<std::string>& required_terms,
           OptionCounts& counts) {
  const std::string& reason = result.outcome.reason;
  switch (result.outcome.status) {
    case solver::Status::solved:
      ++counts["solved"];
      counts["not_finite"] += all_finite(result.quantities) ? 0 : 1;
      return;
    case solver::Status::singular:
      ++counts["singular"];
      counts["unexplained"] += reason.empty() ? 1 : 0;
      return;
    case solver::Status::not_converged:
      ++counts["not_converged"];
      counts["unexplained"] += contains_all_terms(reason, required_terms) ? 0 : 1;
      return;
  }
}

/// Returns a key that identifies a computation. Variants that differ only in options that a
/// combination overwrites have the same key.
std::string computation_key(const Document& document) {
  Json whole = document.value();
  for (const char* text : {"title", "description"}) whole.erase(text);
  return whole.dump();
}

/// Runs one computation with every combination of options.
/// @param seen  keys of completed computations, which are not repeated; new keys are added
void run_combinations(const Document& document, const JsonView& place, const References& references,
                      std::set<std::string>& seen, OptionCounts& counts) {
  const std::string kind = analysis_kind(document);
  const Options options = options_of_analysis(place, kind);
  const Origin written = place.document().origin(place["analyses"].pointer());
  std::optional<AnalysisResult> first;
  for (const Json& combination : options.combinations) {
    Document patched = document;
    patched.apply_patch(written.file, written.pointer, {{"analysis", {{kind, combination}}}});
    if (!seen.insert(computation_key(patched)).second) continue;
    ++counts["attempted"];
    try {
      patched.validate("case");
      AnalysisResult result = analyze(patched, references, {false});
      count(result, options.required_terms, counts);
      if (!options.must_agree) continue;
      if (!first) {
        first = std::move(result);
      } else if (result.outcome.status != first->outcome.status) {
        // Different outcomes count as the largest finite difference, because recorded numbers must
        // be finite.
        record_difference(std::numeric_limits<double>::max(), counts);
      } else {
        record_difference(max_relative_difference(first->quantities, result.quantities), counts);
      }
    } catch (const InputError&) {
      ++counts["refused"];  // an invalid combination ends with an error message
    }
  }
}

/// Returns the cases to be computed for a variant: the variant itself or, if its analysis is a
/// study, the cases with the selected parameter values.
std::vector<Document> cases_to_compute(const Document& document, const JsonView& choice) {
  if (analysis_kind(document) != "study") return {document};
  std::vector<Document> found;
  std::vector<Level> all = cases_of_study_levels(document);
  if (!choice.has("levels")) {
    for (Level& level : all) found.push_back(std::move(level.document));
    return found;
  }
  for (const auto& [number, place] : choice["levels"].entries()) {
    const auto index = place.get<std::size_t>();
    if (index < all.size()) found.push_back(all[index].document);
  }
  return found;
}

}  // namespace

StepResult analyze_options(const Document& document, const References& references, bool,
                           Recorder& record) {
  const JsonView place = JsonView(document)["analysis"]["options"];
  const std::string here = document.origin(place.pointer()).file;
  const Catalogue catalogue;
  OptionCounts all = zero_option_counts();
  for (const auto& [name, choice] : place["cases"].entries()) {
    const Case tried = load_case(catalogue.find_base_case(name, here), catalogue);
    OptionCounts own = zero_option_counts();
    std::set<std::string> seen;
    for (const std::string& variant : tried.variants()) {
      const Document whole = patched(tried, variant);
      if (analysis_kind(whole) == "options")
        throw choice.error("expected a case with an analysis other than 'options'");
      for (const Document& added : cases_to_compute(whole, choice))
        run_combinations(added, place, references, seen, own);
    }
    for (const auto& [quantity, number] : own) {
      record.add(quantity, name, number);
      if (quantity == kDifference) {
        record_difference(number, all);
      } else {
        all[quantity] += number;
      }
    }
  }
  for (const auto& [quantity, number] : all) record.add(quantity, number);
  return {};
}

}  // namespace trammel::harness
