#include "reports/sections/claims.h"

#include <algorithm>
#include <array>

#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

/// How the page shows a verdict: the words say it, the sign and its colour only help to
/// find it.
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

void set_verdict(Data& data, const std::string& verdict) {
  const auto* found =
      std::find_if(kVerdictStyles.begin(), kVerdictStyles.end() - 1,
                   [&](const VerdictStyle& style) { return verdict == style.verdict; });
  data.set("verdict", verdict);
  data.set("status_class", found->css_class);
  data.set("sign", found->sign);
}

std::string number_text(const ClaimInterpretation& interpretation, double value) {
  if (interpretation.metric == "relative") return relative(value, 3, true);
  if (interpretation.metric == "ratio") return "× " + trimmed(value, 4);
  const std::string unit = display_unit(interpretation.unit);
  return trimmed(value, 4) + (unit.empty() ? "" : "\u202f" + unit);
}

/// The value, or the least and the most of several.
std::string measured(const ClaimInterpretation& interpretation) {
  if (interpretation.entries.empty()) return "";
  const auto [lowest, highest] = std::ranges::minmax_element(
      interpretation.entries,
      [](const ClaimEntry& a, const ClaimEntry& b) { return a.value < b.value; });
  const std::string low = number_text(interpretation, lowest->value);
  const std::string high = number_text(interpretation, highest->value);
  return low == high ? low : low + " to " + high;
}

Data interpretation_data(const ClaimInterpretation& interpretation, const Results& results) {
  Data data = object();
  set_verdict(data, interpretation.verdict);
  data.set("description", interpretation.description);
  set_text(data, "measured", measured(interpretation));
  Data cases = list();
  std::vector<std::string> seen;
  for (const ClaimEntry& entry : interpretation.entries) {
    const bool listed = std::ranges::any_of(
        results.runs, [&](const Run& run) { return run.case_id == entry.case_id; });
    if (!listed || std::ranges::find(seen, entry.case_id) != seen.end()) continue;
    seen.push_back(entry.case_id);
    Data data_of_case = object();
    data_of_case.set("case_id", entry.case_id);
    data_of_case.set("case_link", case_link(entry.case_id));
    cases.push_back(data_of_case);
  }
  data.set("cases", cases);
  return data;
}

Data claim_data(const Claim& claim, const Results& results) {
  Data data = object();
  data.set("id", claim.id);
  data.set("claim", claim.claim);
  data.set("place", claim.place);
  data.set("conclusion", claim.verdict == "not measured" ? "No case of these results measures it."
                                                         : claim.conclusion);
  set_text(data, "undecidable", claim.undecidable);
  set_verdict(data, claim.verdict);
  set_text(
      data, "differs",
      claim.verdict == claim.expected || claim.verdict == "not measured" ? "" : claim.expected);
  Data interpretations = list();
  for (const ClaimInterpretation& interpretation : claim.interpretations)
    interpretations.push_back(interpretation_data(interpretation, results));
  data.set("interpretations", interpretations);
  return data;
}

/// "Eq. 14", "Table 2", "Figure 7", "Statement".
std::string item_title(const std::string& id) {
  const std::string kind = id.substr(0, id.find('-')), number = id.substr(id.find('-') + 1);
  if (kind == "equation") return "Eq. " + number;
  if (kind == "statement") return "Statement";
  return (kind == "table" ? "Table " : "Figure ") + number;
}

Data item_data(const PaperItem& item, const Claims& claims) {
  Data data = object();
  data.set("title", item_title(item.id));
  data.set("section", item.section);
  data.set("what", item.what);
  Data shown = list();
  for (const auto& one : item.shown_by) {
    Data entry = object();
    entry.set("case_id", one.case_id);
    entry.set("case_link", case_link(one.case_id));
    set_text(entry, "variant", one.variant);
    set_text(entry, "quantity", one.quantity);
    set_text(entry, "verdict", one.verdict);
    shown.push_back(entry);
  }
  data.set("shown", shown);
  Data verdicts = list();
  for (const Claim& claim : claims.claims) {
    if (std::ranges::find(item.claims, claim.id) == item.claims.end()) continue;
    Data entry = object();
    entry.set("claim_id", claim.id);
    set_verdict(entry, claim.verdict);
    verdicts.push_back(entry);
  }
  data.set("verdicts", verdicts);
  set_text(data, "reason", item.reason);
  set_text(data, "note", item.note);
  return data;
}

/// "2 confirmed, 4 contradicted, ..."
std::string overview(const Claims& claims) {
  std::string text;
  for (const VerdictStyle& style : kVerdictStyles) {
    const auto n = std::ranges::count_if(
        claims.claims, [&](const Claim& claim) { return claim.verdict == style.verdict; });
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + style.verdict;
  }
  return count(claims.claims.size(), "claim") + ": " + text +
         ". Each verdict follows from the interpretations listed below it by a stated rule; a test "
         "fails when it changes.";
}

}  // namespace

Data claims_section(const Results& results) {
  Data section = object();
  if (!results.claims) return section;
  section.set("title", results.claims->title);
  section.set("overview", overview(*results.claims));
  Data claims = list();
  for (const Claim& claim : results.claims->claims) claims.push_back(claim_data(claim, results));
  Data items = list();
  for (const PaperItem& item : results.claims->items)
    items.push_back(item_data(item, *results.claims));
  set_flag(section, "has_items", !results.claims->items.empty());
  section.set("items", items);
  section.set("list", claims);
  return section;
}

}  // namespace trammel::reports
