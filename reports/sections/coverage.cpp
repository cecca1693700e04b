#include "reports/sections/coverage.h"

#include <algorithm>

namespace trammel::reports {
namespace {

using results::CoverageRow;

constexpr const char* kKinds[] = {"exact", "published", "manufactured", "code", "self-consistency"};

Data row_data(const CoverageRow& row) {
  Data data = object();
  data.set("feature", row.feature);
  Data kinds = list();
  for (const char* kind : kKinds) {
    Data cell = object();
    const bool has = std::ranges::find(row.evidence, kind) != row.evidence.end();
    cell.set("mark", has ? "●" : "");
    kinds.push_back(cell);
  }
  data.set("kinds", kinds);
  set_text(data, "judged",
           row.series == 0 ? "" : std::to_string(row.judged) + " of " + std::to_string(row.series));
  set_text(data, "reason", row.reason);
  return data;
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
  Data data = object();
  data.set("title", title);
  set_flag(data, "has_rows", !all.list_value().empty());
  data.set("rows", all);
  data.set("count", std::to_string(verified) + " of " + std::to_string(count_all) +
                        " with independent evidence, " + std::to_string(stated) +
                        " without, for a recorded reason");
  return data;
}

}  // namespace

Data coverage_section(const Results& results, bool with_verified) {
  Data section = object();
  const auto& rows = results.coverage;
  set_flag(section, "has_rows", !rows.empty());
  set_flag(section, "with_verified", with_verified);
  Data groups = list();
  const auto add = [&](const char* group, const char* title) {
    groups.push_back(group_data(rows, group, title, with_verified));
  };
  add("key", "Keys and values of a case");
  add("pair", "Analyses with parts, elements and joints");
  add("quantity", "Quantities");
  section.set("groups", groups);
  Data kinds = list();
  for (const char* kind : kKinds) kinds.push_back(Data(kind));
  section.set("kinds", kinds);
  const auto verified =
      std::ranges::count_if(rows, [](const CoverageRow& row) { return row.is_verified(); });
  int series = 0, judged = 0;
  for (const CoverageRow& row : rows) {
    series += row.series;
    judged += row.judged;
  }
  section.set("words", std::to_string(verified) + " of " + std::to_string(rows.size()) +
                           " features have independent evidence; " + std::to_string(judged) +
                           " of " + std::to_string(series) + " recorded series are judged.");
  return section;
}

}  // namespace trammel::reports
