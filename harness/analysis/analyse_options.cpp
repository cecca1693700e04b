#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "harness/analysis/analysis_kinds.h"
#include "harness/input/case.h"
#include "harness/input/catalogue.h"

namespace trammel {
namespace {

/// What came of all options together.
struct Tally {
  int tried = 0, solved = 0, singular = 0, not_converged = 0, refused = 0;
  int not_finite = 0;        ///< solved, with a number that is none
  int unsaid = 0;            ///< not solved, without the words that its reason must have
  double disagreement = -1;  ///< of what must not change, over what round-off allows

  void disagree(double by) { disagreement = std::max(disagreement, by); }
};

/// The options of one kind of analysis.
struct Options {
  std::vector<Json> combinations;  ///< patches of it
  bool alike = false;              ///< none of them may change a number
  std::vector<std::string> words;  ///< in a reason why it does not converge
};

/// One value of each option that varies, in every combination, over what is set for all.
std::vector<Json> combinations_of(const Cursor& place) {
  std::vector<Json> found = {place.has("set") ? place["set"].json() : Json::object()};
  if (!place.has("vary")) return found;
  for (const auto& [option, values] : place["vary"].entries()) {
    std::vector<Json> more;
    for (const Json& one : found) {
      for (const Json& value : values.json()) {
        more.push_back(one);
        more.back()[option] = value;
      }
    }
    found = std::move(more);
  }
  return found;
}

Options options_of(const Cursor& place, const std::string& kind) {
  Options options{{Json::object()}, false, {}};
  const auto own = place["of"].find(kind);
  if (!own) return options;
  options.combinations = combinations_of(*own);
  options.alike = own->get("alike", false);
  options.words = own->get("says", std::vector<std::string>{});
  return options;
}

/// Largest difference over the round-off that both promise; what promises nothing is left out.
double disagreement_of(const Quantities& a, const Quantities& b) {
  double largest = 0;
  for (const auto& [name, one] : a) {
    const auto other = b.find(name);
    if (other == b.end() || one.roundoff.size() != one.values.size()) continue;
    if (other->second.values.size() != one.values.size()) {
      return std::numeric_limits<double>::infinity();
    }
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      const double x = one.values[i], y = other->second.values[i];
      const double allowed = std::abs(x) * (one.roundoff[i] + (i < other->second.roundoff.size()
                                                                   ? other->second.roundoff[i]
                                                                   : one.roundoff[i]));
      if (x != y) largest = std::max(largest, std::abs(x - y) / allowed);
    }
  }
  return largest;
}

bool all_finite(const Quantities& quantities) {
  return std::all_of(quantities.begin(), quantities.end(), [](const auto& item) {
    return std::all_of(item.second.values.begin(), item.second.values.end(),
                       [](double x) { return std::isfinite(x); });
  });
}

bool says_all(const std::string& reason, const std::vector<std::string>& words) {
  return !reason.empty() && std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return reason.find(word) != std::string::npos;
  });
}

void count(const AnalysisResult& result, const std::vector<std::string>& words, Tally& tally) {
  switch (result.outcome.status) {
    case Status::solved:
      ++tally.solved;
      tally.not_finite += all_finite(result.quantities) ? 0 : 1;
      return;
    case Status::singular:
      ++tally.singular;
      tally.unsaid += result.outcome.reason.empty() ? 1 : 0;
      return;
    case Status::not_converged:
      ++tally.not_converged;
      tally.unsaid += says_all(result.outcome.reason, words) ? 0 : 1;
      return;
  }
}

/// Every combination of options on one computation.
void try_all(const Document& document, const Cursor& place, const References& references,
             Tally& tally) {
  const std::string kind = analysis_kind(document);
  const Options options = options_of(place, kind);
  const Origin written = place.document().origin(place["of"].pointer());
  std::optional<AnalysisResult> first;
  for (const Json& combination : options.combinations) {
    Document patched = document;
    patched.lay(written.file, written.pointer, {{"analysis", {{kind, combination}}}});
    ++tally.tried;
    try {
      patched.check("case");
      AnalysisResult result = analyse(patched, references, {false});
      count(result, options.words, tally);
      if (!options.alike) continue;
      if (!first) {
        first = std::move(result);
      } else if (result.outcome.status != first->outcome.status) {
        tally.disagree(std::numeric_limits<double>::infinity());
      } else {
        tally.disagree(disagreement_of(first->quantities, result.quantities));
      }
    } catch (const InputError&) {
      ++tally.refused;  // in words, as any bad input
    }
  }
}

/// The computations of a variant: one, or some levels of its study.
std::vector<Document> computations_of(const Document& document, const Cursor& choice) {
  if (analysis_kind(document) != "study") return {document};
  std::vector<Document> found;
  std::vector<Level> all = study_levels(document);
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

void record_tally(const std::string& of, const Tally& tally, Recorder& record) {
  record.add("tried", of, tally.tried);
  record.add("solved", of, tally.solved);
  record.add("singular", of, tally.singular);
  record.add("not_converged", of, tally.not_converged);
  record.add("refused", of, tally.refused);
  record.add("not_finite", of, tally.not_finite);
  record.add("unsaid", of, tally.unsaid);
  if (tally.disagreement >= 0) record.add("disagreement", of, tally.disagreement);
}

void add(const Tally& one, Tally& all) {
  all.tried += one.tried;
  all.solved += one.solved;
  all.singular += one.singular;
  all.not_converged += one.not_converged;
  all.refused += one.refused;
  all.not_finite += one.not_finite;
  all.unsaid += one.unsaid;
  all.disagree(one.disagreement);
}

}  // namespace

void analyse_options(const Document& document, const References& references, Recorder& record) {
  const Cursor place = Cursor(document)["analysis"]["options"];
  const std::string here = document.origin(place.pointer()).file;
  Tally all;
  for (const auto& [name, choice] : place["cases"].entries()) {
    const Case tried = load_case(find_extended(name, here));
    Tally own;
    for (const std::string& variant : tried.variants()) {
      const Document whole = patched(tried, variant);
      if (analysis_kind(whole) == "options") throw choice.error("expected a case of another kind");
      for (const Document& one : computations_of(whole, choice)) {
        try_all(one, place, references, own);
      }
    }
    record_tally(name, own, record);
    add(own, all);
  }
  record_tally("", all, record);
}

}  // namespace trammel
