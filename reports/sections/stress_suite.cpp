#include <map>
#include <set>

#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// An indicator of a case: one check, over all variants that it judges.
struct Indicator {
  const Check* worst = nullptr;
  const Run* run = nullptr;       ///< that of the worst
  std::size_t entries = 0;        ///< of all runs together
  std::set<const Run*> variants;  ///< that have it
};

Indicator worst_of(const std::string& check, const std::vector<const Run*>& runs) {
  Indicator found;
  for (const Run* run : runs) {
    for (const Check& entry : run->checks) {
      if (entry.name != check) continue;
      ++found.entries;
      found.variants.insert(run);
      if (found.worst && !worse(entry, *found.worst)) continue;
      found.worst = &entry;
      found.run = run;
    }
  }
  return found;
}

std::string scope_text(const Indicator& indicator, const CaseInfo& info) {
  std::string text =
      indicator.run->variant == "base" ? "" : info.variant_title(indicator.run->variant);
  if (indicator.entries > 1) {
    add_item(text, "worst of " + std::to_string(indicator.entries), "; ");
  }
  return text;
}

/// What was allowed; a bound is its own target.
std::string bound_of(const Check& check) {
  return check.measure == "bound" ? target_text(check) : tolerance_text(check);
}

/// How far it is from what it is compared with, or itself where it is only bounded.
std::string value_of(const Check& check) {
  const bool compared = check.measure != "bound" && check.difference;
  return compared ? difference_text(check) : computed_text(check);
}

Data row_of(const Indicator& indicator, const CaseInfo& info) {
  const Check& check = *indicator.worst;
  return with_status(check_status(check),
                     {{"quantity", check.title.empty() ? quantity_text(check) : check.title},
                      {"of_what", scope_text(indicator, info)},
                      {"value", value_of(check)},
                      {"bound", bound_of(check)},
                      {"why", check.why}});
}

Data missing_row(const std::string& check) {
  return with_status(CheckStatus::not_run, {{"quantity", check},
                                            {"of_what", "no run has it"},
                                            {"value", "–"},
                                            {"bound", "–"},
                                            {"why", ""}});
}

/// "Stress case 7: from 1 to 10,000 elements" is listed under item 7 without its first words.
std::string title_of(const CaseInfo& info) {
  const std::string prefix = "Stress case " + std::to_string(info.stress_suite->item) + ": ";
  if (!info.title.starts_with(prefix)) return info.title;
  return capitalized(info.title.substr(prefix.size()));
}

Data case_of(const CaseInfo& info, const Family& family, Counts& counts) {
  Data rows = list();
  for (const std::string& check : info.stress_suite->indicators) {
    const Indicator indicator = worst_of(check, family.runs_of(info.id));
    ++counts[indicator.worst ? check_status(*indicator.worst) : CheckStatus::not_run];
    rows.push_back(indicator.worst ? row_of(indicator, info) : missing_row(check));
  }
  return object({{"item", std::to_string(info.stress_suite->item)},
                 {"case_title", title_of(info)},
                 {"case_link", case_link(info.id)},
                 {"rows", rows}});
}

std::string text_of(const Counts& counts, std::size_t items, std::size_t cases) {
  std::string text = count(items, "item") + ", " + count(cases, "case") + ", " +
                     count(total(counts), "indicator") + ":";
  for (const CheckStatus status : kAllCheckStatuses) {
    if (count_of(counts, status) == 0) continue;
    text +=
        (text.back() == ':' ? " " : ", ") + std::to_string(count_of(counts, status)) + " " +
        (status == CheckStatus::passes && count_of(counts, status) > 1 ? "pass" : to_text(status));
  }
  return text + ".";
}

}  // namespace

Data stress_suite_section(const std::vector<Family>& families) {
  std::multimap<int, Data> cases;
  std::set<int> items;
  Counts counts;
  for (const Family& family : families) {
    for (const CaseInfo* info : family.cases) {
      if (!info->stress_suite) continue;
      cases.emplace(info->stress_suite->item, case_of(*info, family, counts));
      items.insert(info->stress_suite->item);
    }
  }
  Data in_order = list();
  for (const auto& [item, data] : cases) in_order.push_back(data);
  return object({{"has_rows", !cases.empty()},
                 {"cases", in_order},
                 {"words", text_of(counts, items.size(), cases.size())}});
}

}  // namespace trammel::reports
