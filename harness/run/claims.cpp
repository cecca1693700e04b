#include "harness/run/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "harness/analysis/analysis.h"
#include "harness/base/environment.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/statistic.h"
#include "harness/base/text.h"
#include "harness/results/quantity_definitions.h"
#include "harness/results/result_fields.h"

namespace trammel::harness {
namespace {

using results::PaperItem;

constexpr const char* kClaimsFile = "varalakshmi-2017.json";

// Verdicts of the interpretations of a claim.
constexpr const char *kConfirms = "confirms", *kContradicts = "contradicts",
                     *kConfirmsInPart = "confirms in part", *kInconclusive = "inconclusive",
                     *kNotMeasured = "not measured";
// Verdicts of claims, in addition to kNotMeasured.
constexpr const char *kConfirmed = "confirmed", *kConfirmedInPart = "confirmed in part",
                     *kContradicted = "contradicted", *kCannotBeDecided = "cannot be decided";

using Verdicts = std::set<std::string>;

/// Interpretation of a claim, with data needed only during its evaluation.
struct Interpretation : results::ClaimInterpretation {
  bool incomplete = false;  ///< true: a required run or number is missing
};

/// Ranges of values that confirm or contradict a claim. For other values, `otherwise` applies.
struct Rule {
  std::optional<Window> confirms, contradicts;
  std::string otherwise = kInconclusive;
  bool jointly = false;  ///< if true, all entries of a check share one verdict

  [[nodiscard]] std::string verdict_of_value(double value) const {
    if (confirms && confirms->contains(value)) return kConfirms;
    if (contradicts && contradicts->contains(value)) return kContradicts;
    return otherwise;
  }
};

Rule read_rule(const JsonView& interpretation) {
  Rule rule;
  rule.jointly = interpretation.get("require_all_entries", false);
  const auto read = [&](const char* key, std::optional<Window>& window, const char* verdict) {
    if (!interpretation.has(key)) return;
    if (!interpretation[key].json().is_string()) {
      window = read_window(interpretation[key]);
    } else {
      rule.otherwise = verdict;
    }
  };
  read("confirms", rule.confirms, kConfirms);
  read("contradicts", rule.contradicts, kContradicts);
  if (!rule.confirms && !rule.contradicts)
    throw interpretation.error("expected at least one of the ranges 'confirms' and 'contradicts'");
  if (rule.confirms && rule.contradicts && rule.confirms->low < rule.contradicts->high &&
      rule.contradicts->low < rule.confirms->high) {
    throw interpretation.error("the ranges 'confirms' and 'contradicts' overlap");
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

results::Number metric_of_check(const std::string& metric, CheckResult check_result) {
  if (metric == "value") return check_result.computed;
  if (!check_result.computed || !check_result.expected) return std::nullopt;
  if (*check_result.expected == 0 && metric != "difference") return std::nullopt;
  check_result.measure = metric == "difference" ? "absolute" : metric;
  return results::difference_of_check(check_result);
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
    const auto value = metric_of_check(found.metric, check_result);
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
      if (i >= all.size())
        throw interpretation["index"].error("an index is too large; the number of entries of " +
                                            name + " is " + std::to_string(all.size()));
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

/// Returns the verdicts of the entries. If the rule is joint, each check has one verdict: the check
/// confirms if all its entries confirm, and contradicts if one entry contradicts.
Verdicts verdicts_of_entries(const Rule& rule, const std::vector<results::ClaimEntry>& entries) {
  std::map<std::string, std::string> by_check;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const results::ClaimEntry& entry = entries[i];
    const std::string verdict = rule.verdict_of_value(entry.value);
    const std::string check = entry.case_id + ":" + entry.variant + " " + entry.name;
    const std::string key = rule.jointly ? check : std::to_string(i);
    std::string& joint = by_check.emplace(key, verdict).first->second;
    if (joint != kContradicts && verdict != kConfirms) joint = verdict;
  }
  Verdicts verdicts;
  for (const auto& item : by_check) verdicts.insert(item.second);
  return verdicts;
}

std::string verdict_of(const Rule& rule, const std::vector<results::ClaimEntry>& entries) {
  const Verdicts verdicts = verdicts_of_entries(rule, entries);
  if (verdicts.empty()) return kNotMeasured;
  if (verdicts.size() == 1) return *verdicts.begin();
  return verdicts.count(kConfirms) > 0 ? kConfirmsInPart : kInconclusive;
}

Interpretation evaluate_interpretation(const JsonView& interpretation,
                                       const std::vector<Run>& runs) {
  Interpretation found;
  found.verdict = kNotMeasured;
  found.description = interpretation.text("description");
  found.metric = interpretation.text("metric");
  const bool by_check = interpretation.has("check") || interpretation.has("reference");
  if (by_check == interpretation.has("quantity"))
    throw interpretation.error("expected either 'quantity', or 'check' and/or 'reference'");
  if (by_check ? found.metric == "steps" || interpretation.has("statistic")
               : found.metric != "value" && found.metric != "steps") {
    throw interpretation["metric"].error(
        "expected 'value', 'ratio', 'relative' or 'difference' for a check, or 'value' or 'steps' "
        "for a quantity");
  }
  const Rule rule = read_rule(interpretation);
  for (const Run& run : runs) {
    if (!selects(interpretation, run)) continue;
    by_check ? add_checks(interpretation, run, found) : add_quantity(interpretation, run, found);
  }
  if (!found.incomplete) found.verdict = verdict_of(rule, found.entries);
  return found;
}

std::string verdict_of(const std::vector<Interpretation>& interpretations, bool alternatives) {
  Verdicts verdicts;
  for (const Interpretation& interpretation : interpretations) {
    if (interpretation.incomplete) return kNotMeasured;
    verdicts.insert(interpretation.verdict);
  }
  verdicts.erase(kNotMeasured);
  if (verdicts.empty()) return kNotMeasured;
  if (verdicts == Verdicts{kConfirms}) return kConfirmed;
  if (verdicts == Verdicts{kContradicts}) return kContradicted;
  const bool some = verdicts.count(kConfirms) + verdicts.count(kConfirmsInPart) > 0;
  return some && !alternatives ? kConfirmedInPart : kCannotBeDecided;
}

results::Claim evaluate_claim(const std::string& id, const JsonView& claim,
                              const std::vector<Run>& runs) {
  results::Claim found{id, claim.text("title"),    claim.text("claim"),      claim.text("place"),
                       "", claim.text("expected"), claim.text("conclusion"), "",
                       {}};
  std::ranges::replace(found.expected, '-', ' ');
  if (claim.has("interpretations") == claim.has("undecidable"))
    throw claim.error("expected exactly one of 'interpretations' and 'undecidable'");
  if (claim.has("undecidable")) {
    found.undecidable = claim.text("undecidable");
    found.verdict = kCannotBeDecided;
    return found;
  }
  std::vector<Interpretation> interpretations;
  for (const auto& item : claim["interpretations"].entries())
    interpretations.push_back(evaluate_interpretation(item.second, runs));
  found.verdict =
      verdict_of(interpretations, claim.get<std::string>("combine_as", "parts") == "alternatives");
  found.interpretations.assign(interpretations.begin(), interpretations.end());
  return found;
}

bool interpretation_uses_case(const JsonView& interpretation, const Case& test_case) {
  if (interpretation.has("case")) return interpretation.text("case") == test_case.id();
  for (const auto& [name, check] : JsonView(test_case.document).entries("checks")) {
    if (interpretation.has("check") && matches(name, interpretation.text("check"))) return true;
    if (interpretation.has("reference") &&
        check.get<std::string>("reference", "") == interpretation.text("reference")) {
      return true;
    }
  }
  return false;
}

void require_member(const JsonView& place, const Json& object, const std::string& what) {
  const auto name = place.get<std::string>();
  if (object.contains(name)) return;
  throw place.error("expected a " + what + " (got '" + printable(name) + "')");
}

/// Sets the id of the case that reproduces an item, and validates variant, figure and quantity.
void complete_counterpart_of_item(const JsonView& place, const Catalogue& catalogue,
                                  PaperItem::Counterpart& counterpart) {
  const Case shown = load_case(catalogue.find_case(counterpart.case_id), catalogue);
  counterpart.case_id = shown.id();
  const Json& json = shown.document.value();
  if (!counterpart.variant.empty())
    require_member(place["variant"], json.value("variants", Json::object()), "variant of the case");
  if (!counterpart.figure.empty())
    require_member(place["figure"], json.value("figures", Json::object()), "figure of the case");
  if (!counterpart.quantity.empty() &&
      results::find_quantity_definition(counterpart.quantity, analysis_kind(shown.document)) ==
          nullptr)
    throw place["quantity"].error("the analysis of the case does not compute this quantity");
}

PaperItem read_item(const std::string& id, const JsonView& place, const Json& claims,
                    const Catalogue& catalogue) {
  Json stated = place.json();
  stated["id"] = id;
  auto item = results::from_json<PaperItem>(stated);
  for (std::size_t i = 0; i < item.shown_by.size(); ++i)
    complete_counterpart_of_item(place["shown_by"][i], catalogue, item.shown_by[i]);
  for (const auto& entry : place.entries("claims")) require_member(entry.second, claims, "claim");
  if (item.shown_by.empty() && item.claims.empty() && item.reason.empty())
    throw place.error("an item of the paper requires 'shown_by', 'claims' or 'reason'");
  return item;
}

/// Returns the verdict on the case that reproduces an item: "12 checks pass and 6 known
/// discrepancies", or "computed, not judged".
std::string verdict_of(const results::Results& results, const PaperItem::Counterpart& counterpart) {
  int passed = 0, discrepancies = 0, other = 0;
  bool computed = false;
  for (const results::Run& run : results.runs) {
    if (run.case_id != counterpart.case_id ||
        (!counterpart.variant.empty() && run.variant != counterpart.variant))
      continue;
    computed = true;
    for (const results::Check& check : run.checks) {
      if (!counterpart.quantity.empty() && check.quantity != counterpart.quantity) continue;
      if (check.verdict == results::Verdict::recorded) continue;
      const bool holds = check.verdict == results::Verdict::pass;
      const bool agrees = check.expectation != results::Expectation::known_discrepancy;
      ++(!holds ? other : agrees ? passed : discrepancies);
    }
  }
  if (!computed) return "not computed";
  std::vector<std::string> parts;
  if (passed > 0)
    parts.push_back(fmt::format("{} {}", passed, passed > 1 ? "checks pass" : "check passes"));
  if (discrepancies > 0)
    parts.push_back(fmt::format("{} known {}", discrepancies,
                                discrepancies > 1 ? "discrepancies" : "discrepancy"));
  if (other > 0) parts.push_back(fmt::format("{} fail", other));
  return parts.empty() ? "computed, not judged" : join(parts, "and");
}

}  // namespace

int exit_status(const results::Claims& claims) {
  return claims.as_recorded ? 0 : 1;
}

Document load_claims() {
  const auto file = data_root() / "cases" / "paper" / "claims" / kClaimsFile;
  Document document;
  document.apply_patch(file.string(), "", read_json(file));
  document.validate("claims");
  return document;
}

std::vector<Case> cases_used_by(const Document& claim_set, const std::vector<Case>& catalogue) {
  std::vector<JsonView> interpretations;
  for (const auto& claim : JsonView(claim_set)["claims"].entries())
    for (const auto& item : claim.second.entries("interpretations"))
      interpretations.push_back(item.second);
  std::vector<Case> cases;
  std::ranges::copy_if(catalogue, std::back_inserter(cases), [&](const Case& test_case) {
    return std::ranges::any_of(interpretations, [&](const JsonView& interpretation) {
      return interpretation_uses_case(interpretation, test_case);
    });
  });
  return cases;
}

results::Claims evaluate_claims(const Document& document, const std::vector<Run>& runs) {
  const JsonView root(document);
  results::Claims found;
  found.title = root.text("title");
  for (const auto& [id, claim] : root["claims"].entries())
    found.claims.push_back(evaluate_claim(id, claim, runs));
  found.as_recorded = std::ranges::all_of(
      found.claims, [](const results::Claim& claim) { return claim.verdict == claim.expected; });
  return found;
}

std::vector<PaperItem> load_paper_items(const Document& claim_set, const Catalogue& catalogue) {
  std::vector<PaperItem> items;
  for (const auto& [id, place] : JsonView(claim_set).entries("items"))
    items.push_back(read_item(id, place, claim_set.value().at("claims"), catalogue));
  return items;
}

void judge_paper_items(const results::Results& results, std::vector<PaperItem>& items) {
  for (PaperItem& item : items)
    for (PaperItem::Counterpart& counterpart : item.shown_by)
      counterpart.verdict = verdict_of(results, counterpart);
}

}  // namespace trammel::harness
