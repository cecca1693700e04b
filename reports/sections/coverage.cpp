#include <algorithm>

#include "reports/sections/sections.h"

namespace trammel::reports {
namespace {

constexpr const char* kKinds[] = {"exact", "published", "manufactured", "code", "self-consistency"};

Data row_data(const CoverageRow& row) {
  const auto cell = [&](const char* kind) {
    const bool has = std::ranges::find(row.evidence, kind) != row.evidence.end();
    return object({{"mark", has ? "●" : ""}});
  };
  return object(
      {{"feature", row.feature},
       {"kinds", list_of(kKinds, cell)},
       {"judged",
        row.series == 0 ? "" : std::to_string(row.judged) + " of " + std::to_string(row.series)},
       {"reason", row.reason}});
}

Data group_data(const std::vector<CoverageRow>& rows, const std::string& group,
                const std::string& title, bool with_verified) {
  Data all = list();
  std::size_t count_all = 0, verified = 0, stated = 0;
  // What has no independent evidence first.
  for (const bool is_verified : {false, true}) {
    for (const CoverageRow& row : rows) {
      if (row.group != group || row.is_verified() != is_verified) continue;
      ++count_all;
      verified += is_verified ? 1 : 0;
      stated += row.reason.empty() ? 0 : 1;
      if (with_verified || !is_verified) all.push_back(row_data(row));
    }
  }
  return object({{"title", title},
                 {"has_rows", all.is_non_empty_list()},
                 {"rows", all},
                 {"count", std::to_string(verified) + " of " + std::to_string(count_all) +
                               " with independent evidence, " + std::to_string(stated) +
                               " without, for a recorded reason"}});
}

}  // namespace

Data coverage_section(const Results& results, bool with_verified) {
  const auto& rows = results.coverage;
  Data groups = list();
  const auto add = [&](const char* group, const char* title) {
    groups.push_back(group_data(rows, group, title, with_verified));
  };
  add("key", "Keys and values of a case");
  add("pair", "Analyses with parts, elements and joints");
  add("quantity", "Quantities");
  const auto verified = std::ranges::count_if(rows, &CoverageRow::is_verified);
  int series = 0, judged = 0;
  for (const CoverageRow& row : rows) {
    series += row.series;
    judged += row.judged;
  }
  return object({{"has_rows", !rows.empty()},
                 {"with_verified", with_verified},
                 {"groups", groups},
                 {"kinds", list_of(kKinds, [](const char* kind) { return Data(kind); })},
                 {"words", std::to_string(verified) + " of " + std::to_string(rows.size()) +
                               " features have independent evidence; " + std::to_string(judged) +
                               " of " + std::to_string(series) + " recorded series are judged."}});
}

}  // namespace trammel::reports
