#include <algorithm>
#include <array>

#include "harness/base/find_or_add.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

/// CSS class and symbol of a verdict on a claim. The symbol shows the verdict without color.
struct VerdictStyle {
  const char *verdict, *css_class, *sign;
};
constexpr std::array<VerdictStyle, 10> kVerdictStyles = {{
    {"confirmed", "confirmed", "✓"},
    {"confirmed in part", "partly", "±"},
    {"contradicted", "contradicted", "≠"},
    {"cannot be decided", "undecided", "?"},
    {"not measured", "not-run", "–"},
    {"confirms", "confirmed", "✓"},
    {"contradicts", "contradicted", "≠"},
    {"confirms in part", "partly", "±"},
    {"inconclusive", "undecided", "?"},
    {"", "not-run", "–"},
}};

/// Returns the template data `entries` together with text, CSS class and symbol of a verdict.
Data verdict_data(const std::string& verdict, std::initializer_list<Entry> entries) {
  const auto* found =
      std::find_if(kVerdictStyles.begin(), kVerdictStyles.end() - 1,
                   [&](const VerdictStyle& style) { return verdict == style.verdict; });
  Data data = object(entries);
  set(data, {{"verdict", verdict}, {"status_class", found->css_class}, {"sign", found->sign}});
  return data;
}

std::string number_text(const ClaimInterpretation& interpretation, double value) {
  if (interpretation.metric == "relative") return percent_text(value, 3, true);
  if (interpretation.metric == "ratio") return "× " + trimmed(value, 4);
  const std::string unit = display_unit(interpretation.unit);
  return trimmed(value, 4) + (unit.empty() ? "" : "\u202f" + unit);
}

/// Returns the measured value of a claim under one interpretation, or the range of several values.
std::string measured_range_text(const ClaimInterpretation& interpretation) {
  if (interpretation.entries.empty()) return "";
  const auto [lowest, highest] =
      std::ranges::minmax_element(interpretation.entries, {}, &ClaimEntry::value);
  return limits_text(number_text(interpretation, lowest->value),
                     number_text(interpretation, highest->value));
}

/// Returns the interpretation that decides the verdict on a claim: the first one that contradicts
/// the claim, or else the first interpretation.
ClaimInterpretation deciding_interpretation(const std::vector<ClaimInterpretation>& all) {
  if (all.empty()) return {};
  const auto found = std::ranges::find(all, "contradicts", &ClaimInterpretation::verdict);
  return found == all.end() ? all.front() : *found;
}

Data data_of_interpretation(const ClaimInterpretation& interpretation, const Results& results) {
  Data cases = list();
  std::vector<std::string> seen;
  for (const ClaimEntry& entry : interpretation.entries) {
    const bool has_page = std::ranges::count(results.runs, entry.case_id, &Run::case_id) > 0;
    if (!has_page || harness::contains(seen, entry.case_id)) continue;
    seen.push_back(entry.case_id);
    cases.push_back(object({{"case_id", entry.case_id}, {"case_link", case_link(entry.case_id)}}));
  }
  return verdict_data(interpretation.verdict, {{"description", interpretation.description},
                                               {"measured", measured_range_text(interpretation)},
                                               {"cases", cases}});
}

Data claim_data(const Claim& claim, const Results& results) {
  const auto interpretation = [&](const ClaimInterpretation& reading) {
    return data_of_interpretation(reading, results);
  };
  const ClaimInterpretation deciding = deciding_interpretation(claim.interpretations);
  return verdict_data(
      claim.verdict,
      {{"id", claim.id},
       {"claim", claim.claim},
       {"short", claim.title.empty() ? claim.claim : claim.title},
       {"deciding", measured_range_text(deciding)},
       {"meaning", deciding.description},
       {"place", claim.place},
       {"conclusion", claim.verdict == "not measured"
                          ? "No case of these results measures this claim."
                          : claim.conclusion},
       {"undecidable", claim.undecidable},
       {"differs",
        claim.verdict == claim.expected || claim.verdict == "not measured" ? "" : claim.expected},
       {"interpretations", list_of(claim.interpretations, interpretation)}});
}

/// Returns "Eq. 14", "Table 2", "Figure 7" or "Statement".
std::string item_title(const std::string& id) {
  const std::string kind = id.substr(0, id.find('-')), number = id.substr(id.find('-') + 1);
  if (kind == "equation") return "Eq. " + number;
  if (kind == "statement") return "Statement";
  return (kind == "table" ? "Table " : "Figure ") + number;
}

Data data_of_paper_item(const PaperItem& item, const Claims& claims) {
  const auto shown = [](const PaperItem::Counterpart& counterpart) {
    return object({{"case_id", counterpart.case_id},
                   {"case_link", case_link(counterpart.case_id)},
                   {"variant", counterpart.variant},
                   {"quantity", counterpart.quantity},
                   {"verdict", counterpart.verdict}});
  };
  Data verdicts = list();
  for (const Claim& claim : claims.claims)
    if (harness::contains(item.claims, claim.id))
      verdicts.push_back(verdict_data(claim.verdict, {{"claim_id", claim.id}}));
  return object({{"title", item_title(item.id)},
                 {"section", item.section},
                 {"what", item.what},
                 {"shown", list_of(item.shown_by, shown)},
                 {"verdicts", verdicts},
                 {"reason", item.reason},
                 {"note", item.note}});
}

/// Returns the number of claims of each verdict as text.
std::string verdict_counts_text(const Claims& claims) {
  std::string text;
  for (const VerdictStyle& style : kVerdictStyles) {
    const auto n = std::ranges::count_if(
        claims.claims, [&](const Claim& claim) { return claim.verdict == style.verdict; });
    if (n > 0) add_item(text, std::to_string(n) + " " + style.verdict);
  }
  return count(claims.claims.size(), "claim") + ": " + text + ". Fixed rules decide each verdict.";
}

}  // namespace

Data claims_section(const Results& results) {
  if (!results.claims) return object({{"has_rows", false}});
  const Claims& claims = *results.claims;
  const auto item = [&](const PaperItem& shown) { return data_of_paper_item(shown, claims); };
  const auto verdict = [&](const Claim& claim) { return claim_data(claim, results); };
  return object({{"title", claims.title},
                 {"overview", verdict_counts_text(claims)},
                 {"has_items", !claims.items.empty()},
                 {"items", list_of(claims.items, item)},
                 {"list", list_of(claims.claims, verdict)}});
}

}  // namespace trammel::reports
