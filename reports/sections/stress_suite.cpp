#include "reports/sections/stress_suite.h"

#include <algorithm>
#include <map>
#include <set>

#include "reports/data/check_status.h"
#include "reports/data/check_text.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
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
    text += (text.empty() ? "" : "; ") + ("worst of " + std::to_string(indicator.entries));
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
  Data row = object();
  row.set("quantity", check.title.empty() ? quantity_text(check) : check.title);
  set_text(row, "of_what", scope_text(indicator, info));
  row.set("value", value_of(check));
  row.set("bound", bound_of(check));
  set_text(row, "why", check.why);
  set_check_status(row, check_status(check));
  return row;
}

Data missing_row(const std::string& check) {
  Data row = object();
  row.set("quantity", check);
  set_text(row, "of_what", "no run has it");
  row.set("value", "–");
  row.set("bound", "–");
  set_text(row, "why", "");
  set_check_status(row, CheckStatus::not_run);
  return row;
}

/// Links to the figures that the case asks for.
Data pictures_of(const CaseInfo& info, const Gallery& gallery) {
  Data pictures = list();
  for (const PlotRequest& request : info.figures) {
    const auto figure = std::ranges::find_if(gallery.shown, [&](const Figure& drawn) {
      return drawn.id == slug(info.id + "-" + request.id);
    });
    if (figure == gallery.shown.end()) continue;
    Data picture = object();
    picture.set("link", case_link(info.id) + "#fig-" + figure->id);
    picture.set("number", std::to_string(figure->number));
    pictures.push_back(picture);
  }
  return pictures;
}

/// "Stress case 7: from 1 to 10,000 elements" is listed under item 7 without its first words.
std::string title_of(const CaseInfo& info) {
  const std::string prefix = "Stress case " + std::to_string(info.stress_suite->item) + ": ";
  if (!info.title.starts_with(prefix)) return info.title;
  std::string title = info.title.substr(prefix.size());
  if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

Data case_of(const CaseInfo& info, const Family& family, Counts& counts) {
  Data data = object();
  data.set("item", std::to_string(info.stress_suite->item));
  data.set("case_title", title_of(info));
  data.set("case_link", case_link(info.id));
  data.set("pictures", pictures_of(info, family.galleries.at(info.id)));
  Data rows = list();
  for (const std::string& check : info.stress_suite->indicators) {
    const Indicator indicator = worst_of(check, family.runs_of(info.id));
    ++counts[indicator.worst ? check_status(*indicator.worst) : CheckStatus::not_run];
    rows.push_back(indicator.worst ? row_of(indicator, info) : missing_row(check));
  }
  data.set("rows", rows);
  return data;
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
  Data section = object();
  Data in_order = list();
  for (const auto& [item, data] : cases) in_order.push_back(data);
  set_flag(section, "has_rows", !cases.empty());
  section.set("cases", in_order);
  section.set("words", text_of(counts, items.size(), cases.size()));
  std::string missing_items;
  for (int item = 1; !items.empty() && item < *items.rbegin(); ++item) {
    if (!items.contains(item))
      missing_items += (missing_items.empty() ? "" : ", ") + std::to_string(item);
  }
  set_text(section, "missing_items", missing_items);
  return section;
}

}  // namespace trammel::reports
