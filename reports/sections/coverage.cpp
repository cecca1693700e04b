#include <array>

#include "harness/base/find_or_add.h"
#include "reports/sections/sections.h"

namespace trammel::reports {

namespace {

constexpr std::array<const char*, 5> kEvidence = {"exact", "published", "manufactured", "code",
                                                  "self-consistency"};

/// Returns the features of a group, those without independent evidence first.
Data group_data(const std::vector<CoverageRow>& rows, const std::string& group,
                const std::string& title) {
  TextTable table{title, {"Feature"}};
  table.heads.insert(table.heads.end(), kEvidence.begin(), kEvidence.end());
  table.heads.insert(table.heads.end(), {"Series judged", "Reason for no independent evidence"});
  std::size_t verified = 0, with_reason = 0;
  for (const bool is_verified : {false, true}) {
    for (const CoverageRow& row : rows) {
      if (row.group != group || row.is_verified() != is_verified) continue;
      if (is_verified) ++verified;
      if (!row.reason.empty()) ++with_reason;
      std::vector<std::string>& cells = table.rows.emplace_back();
      cells = {row.feature};
      for (const char* kind : kEvidence)
        cells.emplace_back(harness::contains(row.evidence, kind) ? "●" : "");
      cells.push_back(row.series ? std::to_string(row.judged) + " of " + std::to_string(row.series)
                                 : "");
      cells.push_back(row.reason);
    }
  }
  Data data = table_data(table);
  data.set("count", std::to_string(verified) + " of " + std::to_string(table.rows.size()) +
                        " with independent evidence, " + std::to_string(with_reason) +
                        " without, for a recorded reason");
  return data;
}

}  // namespace

Data coverage_section(const Results& results) {
  const auto& rows = results.coverage;
  Data groups = list();
  groups.push_back(group_data(rows, "key", "Keys and values of a case"));
  groups.push_back(group_data(rows, "pair", "Types of analysis with parts, elements and joints"));
  groups.push_back(group_data(rows, "quantity", "Quantities"));
  int verified = 0, series = 0, judged = 0;
  for (const CoverageRow& row : rows) {
    verified += row.is_verified() ? 1 : 0;
    series += row.series;
    judged += row.judged;
  }
  return object({{"has_rows", !rows.empty()},
                 {"groups", groups},
                 {"words", std::to_string(verified) + " of " + std::to_string(rows.size()) +
                               " features have independent evidence; " + std::to_string(judged) +
                               " of " + std::to_string(series) + " recorded series are judged."}});
}

}  // namespace trammel::reports
