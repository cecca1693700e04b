#include <algorithm>

#include "reports/number.h"
#include "reports/sections.h"

namespace trammel::reports {

namespace {

constexpr std::size_t most_open = 12;

struct CaseCost {
  const CaseInfo* info;
  std::size_t runs = 0;
  double wall_s = 0, cpu_s = 0;
  std::vector<std::pair<std::string, double>> counters;
};

std::vector<CaseCost> costs(const std::vector<Family>& families) {
  std::vector<CaseCost> out;
  for (const Family& family : families) {
    for (const CaseInfo* info : family.cases) {
      CaseCost cost;
      cost.info = info;
      for (const Run* run : family.runs_of(info->id)) {
        ++cost.runs;
        cost.wall_s += run->cost.wall_s;
        cost.cpu_s += run->cost.cpu_s;
        for (const auto& [name, n] : run->cost.counters) {
          auto known = std::find_if(cost.counters.begin(), cost.counters.end(),
                                    [&, key = name](const auto& c) { return c.first == key; });
          if (known == cost.counters.end()) {
            cost.counters.emplace_back(name, n);
          } else {
            known->second += n;
          }
        }
      }
      out.push_back(std::move(cost));
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const CaseCost& a, const CaseCost& b) { return a.wall_s > b.wall_s; });
  return out;
}

/// 1 240 000 with thin spaces.
std::string grouped(double n) {
  std::string digits = shortest(n);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return trimmed(n, 4);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202f";
    out += digits[i];
  }
  return out;
}

std::string counters_text(const CaseCost& cost) {
  std::string text;
  for (const auto& [name, n] : cost.counters) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += (text.empty() ? "" : ", ") + grouped(n) + " " + words;
  }
  return text;
}

Data row_of(const CaseCost& cost, double longest) {
  Data row = object();
  row.set("case_title", cost.info->title);
  row.set("case_anchor", case_anchor(cost.info->id));
  row.set("runs", std::to_string(cost.runs));
  row.set("wall", duration(cost.wall_s));
  row.set("cpu", duration(cost.cpu_s));
  row.set("percent", trimmed(longest > 0 ? 100 * cost.wall_s / longest : 0, 3));
  set_text(row, "counters", counters_text(cost));
  return row;
}

}  // namespace

Data cost_section(const Results&, const std::vector<Family>& families) {
  const std::vector<CaseCost> all = costs(families);
  double wall = 0, cpu = 0;
  for (const CaseCost& cost : all) wall += cost.wall_s, cpu += cost.cpu_s;
  Data section = object();
  std::string words = "All runs together took " + duration(wall) + " one after another (" +
                      duration(cpu) + " of processor time)";
  if (!all.empty() && wall > 0)
    words += "; the longest case, " + all.front().info->title + ", has " +
             relative(all.front().wall_s / wall, 2, false) + " of it";
  section.set("words", words + ".");
  Data open = list();
  Data folded = list();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool shown = i < most_open || all.size() <= most_open + 3;
    (shown ? open : folded).push_back(row_of(all[i], all.front().wall_s));
  }
  section.set("rows", open);
  set_flag(section, "has_folded", folded.is_non_empty_list());
  section.set("folded_title", folded.is_non_empty_list()
                                  ? count(folded.list_value().size(), "quicker case")
                                  : std::string());
  section.set("folded", folded);
  return section;
}

}  // namespace trammel::reports
