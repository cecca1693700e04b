#include "harness/run/claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "harness/base/contains.h"
#include "harness/base/data_root.h"
#include "harness/base/json_file.h"
#include "harness/base/statistic.h"

namespace trammel::harness {
namespace {

constexpr const char* kClaimsFile = "varalakshmi-2017.json";

/// Which values a window holds; one side may take all that the other's window does not.
struct Rule {
  std::optional<Window> confirms, contradicts;
  InterpretationVerdict otherwise = InterpretationVerdict::undecided;
  bool jointly = false;  ///< the entries of one check count as one

  [[nodiscard]] InterpretationVerdict verdict_of_value(double value) const {
    if (confirms && confirms->contains(value)) return InterpretationVerdict::confirms;
    if (contradicts && contradicts->contains(value)) return InterpretationVerdict::contradicts;
    return otherwise;
  }
};

Window read_window(const JsonView& interval) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto side = [&](std::size_t i, double open) {
    return interval[i].json().is_null() ? open : interval[i].get<double>();
  };
  return {side(0, -infinity), side(1, infinity)};
}

Rule read_rule(const JsonView& interpretation) {
  Rule rule;
  rule.jointly = interpretation.get("require_all_entries", false);
  const auto read = [&](const char* key, std::optional<Window>& window,
                        InterpretationVerdict verdict) {
    if (!interpretation.has(key)) return;
    if (!interpretation[key].json().is_string()) {
      window = read_window(interpretation[key]);
    } else {
      rule.otherwise = verdict;
    }
  };
  read("confirms", rule.confirms, InterpretationVerdict::confirms);
  read("contradicts", rule.contradicts, InterpretationVerdict::contradicts);
  if (!rule.confirms && !rule.contradicts) {
    throw interpretation.error("expected a window in 'confirms' or 'contradicts'");
  }
  if (rule.confirms && rule.contradicts && rule.confirms->low < rule.contradicts->high &&
      rule.contradicts->low < rule.confirms->high) {
    throw interpretation.error("expected windows of which no value is in both");
  }
  return rule;
}

bool matches(const std::string& name, const std::string& pattern) {
  if (pattern.empty() || pattern.back() != '*') return name == pattern;
  return name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

bool selects(const JsonView& interpretation, const Run& run) {
  if (interpretation.has("case") && interpretation.text("case") != run.case_id) return false;
  if (!interpretation.has("variants")) return true;
  const auto variants = interpretation["variants"].get<std::vector<std::string>>();
  return contains(variants, run.variant);
}

results::Number metric_of(const std::string& metric, const CheckResult& check_result) {
  if (metric == "value") return check_result.computed;
  if (!check_result.computed || !check_result.expected) return std::nullopt;
  const double computed = *check_result.computed, expected = *check_result.expected;
  if (metric == "difference") return computed - expected;
  if (expected == 0) return std::nullopt;
  return metric == "ratio" ? computed / expected : (computed - expected) / std::abs(expected);
}

void add_checks(const JsonView& interpretation, const Run& run, Interpretation& found) {
  for (const CheckResult& check_result : run.checks) {
    const bool named =
        interpretation.has("check") && matches(check_result.name, interpretation.text("check"));
    const bool against = interpretation.has("reference") &&
                         check_result.reference == interpretation.text("reference");
    if (!named && !against) continue;
    if (interpretation.has("index")) {
      const auto index = interpretation["index"].get<std::vector<int>>();
      const bool chosen = check_result.index && contains(index, *check_result.index);
      if (!chosen) continue;
    }
    const auto value = metric_of(found.metric, check_result);
    if (!run.is_solved() || !value || !std::isfinite(*value)) {
      found.incomplete = true;
      continue;
    }
    found.unit = found.metric == "ratio" || found.metric == "relative" ? "1" : check_result.unit;
    found.entries.push_back({run.case_id, run.variant, check_result.name, *value});
  }
}

void add_quantity(const JsonView& interpretation, const Run& run, Interpretation& found) {
  const std::string name = interpretation.text("quantity");
  const auto quantity = run.quantities.find(name);
  if (quantity == run.quantities.end() || quantity->second.values.empty()) {
    found.incomplete = true;
    return;
  }
  std::vector<double> values;
  const std::vector<double>& all = quantity->second.values;
  if (interpretation.has("index")) {
    for (const auto i : interpretation["index"].get<std::vector<std::size_t>>()) {
      if (i >= all.size()) {
        throw interpretation["index"].error("expected entries that " + name + " has, which are " +
                                            std::to_string(all.size()));
      }
      values.push_back(all[i]);
    }
  } else {
    values = all;
  }
  if (found.metric == "steps") {
    std::adjacent_difference(values.begin(), values.end(), values.begin());
    values.erase(values.begin());
  }
  if (interpretation.has("statistic"))
    values = {statistic_of(interpretation.text("statistic"), values)};
  found.unit = unit_of(name);
  for (const double value : values) {
    if (std::isfinite(value)) {
      found.entries.push_back({run.case_id, run.variant, name, value});
    } else {
      found.incomplete = true;
    }
  }
}

/// One verdict for each entry, or for each check: it confirms where all its entries do, and
/// contradicts where one does.
std::vector<InterpretationVerdict> verdicts_of(const Rule& rule,
                                               const std::vector<results::ClaimEntry>& entries) {
  std::vector<InterpretationVerdict> verdicts;
  const results::ClaimEntry* before = nullptr;
  for (const results::ClaimEntry& entry : entries) {
    const InterpretationVerdict verdict = rule.verdict_of_value(entry.value);
    const bool same = rule.jointly && before && before->case_id == entry.case_id &&
                      before->variant == entry.variant && before->name == entry.name;
    before = &entry;
    if (!same) {
      verdicts.push_back(verdict);
    } else if (verdicts.back() != InterpretationVerdict::contradicts &&
               verdict != InterpretationVerdict::confirms) {
      verdicts.back() = verdict;
    }
  }
  return verdicts;
}

InterpretationVerdict verdict_of(const Rule& rule,
                                 const std::vector<results::ClaimEntry>& entries) {
  const std::vector<InterpretationVerdict> each = verdicts_of(rule, entries);
  const std::set<InterpretationVerdict> verdicts(each.begin(), each.end());
  if (verdicts.empty()) return InterpretationVerdict::not_measured;
  if (verdicts.size() == 1) return *verdicts.begin();
  if (verdicts.count(InterpretationVerdict::confirms) > 0) return InterpretationVerdict::in_part;
  return InterpretationVerdict::undecided;
}

Interpretation evaluate_interpretation(const std::string& name, const JsonView& interpretation,
                                       const std::vector<Run>& runs) {
  Interpretation found;
  found.name = name;
  found.what = interpretation.text("description");
  found.metric = interpretation.text("metric");
  const bool by_check = interpretation.has("check") || interpretation.has("reference");
  if (by_check == interpretation.has("quantity")) {
    throw interpretation.error("expected either a 'check' or 'reference', or a 'quantity'");
  }
  if (by_check ? found.metric == "steps" || interpretation.has("statistic")
               : found.metric != "value" && found.metric != "steps") {
    throw interpretation["metric"].error(
        "expected a check's value, ratio, relative or difference, or a "
        "quantity's value or steps");
  }
  const Rule rule = read_rule(interpretation);
  for (const Run& run : runs) {
    if (!selects(interpretation, run)) continue;
    by_check ? add_checks(interpretation, run, found) : add_quantity(interpretation, run, found);
  }
  if (!found.incomplete) found.verdict = verdict_of(rule, found.entries);
  return found;
}

ClaimVerdict verdict_of(const std::vector<Interpretation>& interpretations, bool alternatives) {
  std::set<InterpretationVerdict> verdicts;
  for (const Interpretation& interpretation : interpretations) {
    if (interpretation.incomplete) return ClaimVerdict::not_measured;
    verdicts.insert(interpretation.verdict);
  }
  verdicts.erase(InterpretationVerdict::not_measured);
  if (verdicts.empty()) return ClaimVerdict::not_measured;
  if (verdicts.size() == 1) {
    switch (*verdicts.begin()) {
      case InterpretationVerdict::confirms:
        return ClaimVerdict::confirmed;
      case InterpretationVerdict::contradicts:
        return ClaimVerdict::contradicted;
      case InterpretationVerdict::in_part:
        return alternatives ? ClaimVerdict::cannot_be_decided : ClaimVerdict::confirmed_in_part;
      default:
        return ClaimVerdict::cannot_be_decided;
    }
  }
  const bool some = verdicts.count(InterpretationVerdict::confirms) +
                        verdicts.count(InterpretationVerdict::in_part) >
                    0;
  return some && !alternatives ? ClaimVerdict::confirmed_in_part : ClaimVerdict::cannot_be_decided;
}

ClaimVerdict read_verdict(const std::string& word) {
  if (word == "confirmed") return ClaimVerdict::confirmed;
  if (word == "confirmed-in-part") return ClaimVerdict::confirmed_in_part;
  if (word == "contradicted") return ClaimVerdict::contradicted;
  return word == "not-measured" ? ClaimVerdict::not_measured : ClaimVerdict::cannot_be_decided;
}

Claim evaluate_claim(const std::string& id, const JsonView& claim, const std::vector<Run>& runs) {
  Claim found;
  found.id = id;
  found.claim = claim.text("claim");
  found.place = claim.text("place");
  found.conclusion = claim.text("conclusion");
  found.expected = read_verdict(claim.text("expected"));
  if (claim.has("interpretations") == claim.has("undecidable")) {
    throw claim.error("expected either 'interpretations' or why it is 'undecidable'");
  }
  if (claim.has("undecidable")) {
    found.undecidable = claim.text("undecidable");
    found.verdict = ClaimVerdict::cannot_be_decided;
    return found;
  }
  for (const auto& [name, interpretation] : claim["interpretations"].entries()) {
    found.interpretations.push_back(evaluate_interpretation(name, interpretation, runs));
  }
  found.verdict = verdict_of(found.interpretations,
                             claim.get<std::string>("combine_as", "parts") == "alternatives");
  return found;
}

bool rests_on(const JsonView& interpretation, const Case& test_case) {
  if (interpretation.has("case")) return interpretation.text("case") == test_case.id();
  const auto checks = JsonView(test_case.document).find("checks");
  if (!checks) return false;
  for (const auto& [name, check] : checks->entries()) {
    if (interpretation.has("check") && matches(name, interpretation.text("check"))) return true;
    if (interpretation.has("reference") &&
        check.get<std::string>("reference", "") == interpretation.text("reference")) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool ClaimSet::as_expected() const {
  return std::ranges::all_of(claims, [](const Claim& claim) { return claim.as_expected(); });
}

int exit_status(const ClaimSet& claim_set) {
  return claim_set.as_expected() ? 0 : 1;
}

Document load_claims() {
  const auto file = data_root() / "cases" / "paper" / "claims" / kClaimsFile;
  Document document;
  document.apply_patch(file.string(), "", read_json(file));
  document.validate("claims");
  return document;
}

std::vector<Case> cases_of(const Document& claim_set, const std::vector<Case>& catalogue) {
  std::vector<JsonView> interpretations;
  for (const auto& [id, claim] : JsonView(claim_set)["claims"].entries()) {
    if (!claim.has("interpretations")) continue;
    for (const auto& [name, interpretation] : claim["interpretations"].entries())
      interpretations.push_back(interpretation);
  }
  std::vector<Case> cases;
  std::ranges::copy_if(catalogue, std::back_inserter(cases), [&](const Case& test_case) {
    return std::ranges::any_of(interpretations, [&](const JsonView& interpretation) {
      return rests_on(interpretation, test_case);
    });
  });
  return cases;
}

ClaimSet evaluate_claims(const Document& document, const std::vector<Run>& runs) {
  const JsonView root(document);
  ClaimSet claim_set{root.text("title"), root.text("source"), {}};
  for (const auto& [id, claim] : root["claims"].entries()) {
    claim_set.claims.push_back(evaluate_claim(id, claim, runs));
  }
  return claim_set;
}

std::string to_text(ClaimVerdict verdict) {
  constexpr std::array texts = {"confirmed", "confirmed in part", "contradicted",
                                "cannot be decided", "not measured"};
  return texts[static_cast<std::size_t>(verdict)];
}

std::string to_text(InterpretationVerdict verdict) {
  constexpr std::array texts = {"confirms", "contradicts", "confirms in part", "inconclusive",
                                "not measured"};
  return texts[static_cast<std::size_t>(verdict)];
}

results::Claims claim_results(const ClaimSet& claim_set) {
  results::Claims out{claim_set.title, claim_set.as_expected(), {}};
  for (const Claim& claim : claim_set.claims) {
    out.claims.push_back({claim.id,
                          claim.claim,
                          claim.place,
                          to_text(claim.verdict),
                          to_text(claim.expected),
                          claim.conclusion,
                          claim.undecidable,
                          {}});
    for (const Interpretation& found : claim.interpretations)
      out.claims.back().interpretations.push_back(
          {found.what, found.metric, found.unit, to_text(found.verdict), found.entries});
  }
  return out;
}

}  // namespace trammel::harness
