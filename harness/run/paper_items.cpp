#include "harness/run/paper_items.h"

#include "harness/analysis/analysis.h"
#include "harness/base/text.h"
#include "harness/results/quantity_definitions.h"

namespace trammel::harness {
namespace {

using results::PaperItem;

void require_member(const JsonView& place, const Json& object, const std::string& what) {
  const auto name = place.get<std::string>();
  if (object.contains(name)) return;
  throw place.error("expected a " + what + " (got '" + printable(name) + "')");
}

PaperItem::Counterpart read_counterpart(const JsonView& place, const Catalogue& catalogue) {
  const Case shown = load_case(catalogue.find_case(place.text("case")), catalogue);
  PaperItem::Counterpart counterpart{shown.id(), place.get<std::string>("variant", ""),
                                     place.get<std::string>("quantity", ""),
                                     place.get<std::string>("figure", ""), ""};
  const Json& json = shown.document.value();
  if (!counterpart.variant.empty())
    require_member(place["variant"], json.value("variants", Json::object()), "variant of the case");
  if (!counterpart.figure.empty())
    require_member(place["figure"], json.value("figures", Json::object()), "figure of the case");
  if (!counterpart.quantity.empty() &&
      results::find_quantity_definition(counterpart.quantity, analysis_kind(shown.document)) ==
          nullptr)
    throw place["quantity"].error("expected a quantity of the case's analysis");
  return counterpart;
}

PaperItem read_item(const std::string& id, const JsonView& place, const Json& claims,
                    const Catalogue& catalogue) {
  PaperItem item{id, place.text("section"), place.text("what")};
  item.reason = place.get<std::string>("reason", "");
  item.note = place.get<std::string>("note", "");
  if (const auto shown = place.find("shown_by"))
    for (const auto& entry : shown->entries())
      item.shown_by.push_back(read_counterpart(entry.second, catalogue));
  if (const auto stated = place.find("claims")) {
    for (const auto& entry : stated->entries()) {
      require_member(entry.second, claims, "claim");
      item.claims.push_back(entry.second.get<std::string>());
    }
  }
  if (item.shown_by.empty() && item.claims.empty() && item.reason.empty())
    throw place.error("expected 'shown_by', 'claims' or 'reason'");
  return item;
}

/// "12 checks pass, 6 do not agree (as recorded)", or "computed, not judged".
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
    parts.push_back(std::to_string(passed) + (passed > 1 ? " checks pass" : " check passes"));
  if (discrepancies > 0)
    parts.push_back(std::to_string(discrepancies) + " do not agree (as recorded)");
  if (other > 0) parts.push_back(std::to_string(other) + " fail");
  return parts.empty() ? "computed, not judged" : join(parts, "and");
}

}  // namespace

std::vector<PaperItem> load_paper_items(const Document& claim_set, const Catalogue& catalogue) {
  std::vector<PaperItem> items;
  const auto stated = JsonView(claim_set).find("items");
  if (!stated) return items;
  for (const auto& [id, place] : stated->entries())
    items.push_back(read_item(id, place, claim_set.value().at("claims"), catalogue));
  return items;
}

void judge_paper_items(const results::Results& results, std::vector<PaperItem>& items) {
  for (PaperItem& item : items)
    for (PaperItem::Counterpart& counterpart : item.shown_by)
      counterpart.verdict = verdict_of(results, counterpart);
}

}  // namespace trammel::harness
