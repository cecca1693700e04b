#include <algorithm>
#include <map>
#include <set>

#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Worst value of one check over all variants of a case of the stress suite, which examines
/// numerical stability.
struct Indicator {
  const Check* worst = nullptr;
  const Run* run = nullptr;  ///< run with the worst value
  std::size_t entries = 0;   ///< number of checked values in all runs
};

Indicator make_indicator(const std::string& check, const std::vector<const Run*>& runs) {
  Indicator found;
  for (const Run* run : runs)
    for (const Check& entry : run->checks) {
      if (entry.name != check) continue;
      ++found.entries;
      if (!found.worst || is_worse_than(entry, *found.worst)) found.worst = &entry, found.run = run;
    }
  return found;
}

/// Returns the table row of an indicator. It shows the worst difference from the reference, or the
/// worst computed value if the check is a bound.
Data row_of(const Indicator& indicator, const CaseInfo& info) {
  const Check& check = *indicator.worst;
  const bool is_bound = check.measure == "bound";
  auto scope = indicator.run->variant == "base" ? "" : info.variant_title(indicator.run->variant);
  if (indicator.entries > 1) add_item(scope, "worst of " + std::to_string(indicator.entries), "; ");
  return status_data(
      find_status(check),
      {{"quantity", check.title.empty() ? quantity_text(check) : check.title},
       {"of_what", scope},
       {"value", is_bound || !check.difference ? computed_text(check) : difference_text(check)},
       {"bound", is_bound ? target_text(check) : tolerance_text(check)},
       {"why", check.why}});
}

Data case_of(const CaseInfo& info, const Family& family, Counts& counts) {
  double largest = 0;
  for (const Run* run : family.runs_of(info.id))
    for (const Check& check : run->checks)
      if (is_numeric(check)) largest = std::max(largest, difference_over_tolerance(check));
  Data rows = list();
  for (const std::string& check : info.stress_suite->indicators) {
    const Indicator indicator = make_indicator(check, family.runs_of(info.id));
    ++counts[indicator.worst ? find_status(*indicator.worst) : CheckStatus::not_run];
    rows.push_back(indicator.worst
                       ? row_of(indicator, info)
                       : status_data(CheckStatus::not_run,
                                     {{"quantity", check}, {"of_what", "no run has this check"}}));
  }
  return object({{"case_title", info.title},
                 {"case_link", case_link(info.id)},
                 {"largest", percent_text(largest, 2, false)},
                 {"rows", rows}});
}

std::string counts_text(const Counts& counts, std::size_t items, std::size_t cases) {
  std::string text;
  for (const auto& [status, n] : counts)
    add_item(text, std::to_string(n) + " " +
                       (status == CheckStatus::passes && n > 1 ? "pass" : find_style(status).text));
  return count(items, "item") + ", " + count(cases, "case") + ", " +
         count(total(counts), "indicator") + ": " + text + ".";
}

}  // namespace

Data stress_suite_section(const std::vector<Family>& families, const StudyFigures& figures) {
  std::multimap<int, Data> cases;
  std::set<int> items;
  Counts counts;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases)
      if (info->stress_suite) {
        cases.emplace(info->stress_suite->item, case_of(*info, family, counts));
        items.insert(info->stress_suite->item);
      }
  return object({{"has_rows", !cases.empty()},
                 {"figures", list_of(figures.stress, figure_data)},
                 {"cases", list_of(cases, [](const auto& entry) { return entry.second; })},
                 {"words", counts_text(counts, items.size(), cases.size())}});
}

}  // namespace trammel::reports
