#include <algorithm>
#include <cmath>

#include "harness/base/statistic.h"
#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// As the cases' schema names them; empty where a value is missing.
Number statistic(const std::string& name, const std::vector<double>& values) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    return std::nullopt;
  return harness::statistic_of(name.empty() ? "first" : name, values);
}

Number timing_of(const Run& run, const std::string& name) {
  for (const auto& [key, seconds, evaluations] : run.cost.timings)
    if (key == name) return seconds;
  return std::nullopt;
}

std::string cell_text(const ColumnRequest& column, const Run& run) {
  if (column.timing.empty()) {
    const std::vector<double>* numbers = run.quantity(column.quantity);
    return or_dash(numbers ? statistic(column.statistic, *numbers) : std::nullopt, 3);
  }
  const Number time = timing_of(run, column.timing);
  if (!time) return or_dash(std::nullopt, 3);
  if (column.over_timing.empty()) return duration(*time);
  const Number other = timing_of(run, column.over_timing);
  if (!other || *other == 0) return or_dash(std::nullopt, 3);
  return "× " + trimmed(*time / *other, 2);
}

Data row_of(const TableRequest& table, const CaseInfo& info, const Run& run) {
  const auto cell = [&](const ColumnRequest& column) {
    return object({{"value", cell_text(column, run)}});
  };
  return object(
      {{"variant", info.variant_title(run.variant)}, {"cells", list_of(table.columns, cell)}});
}

}  // namespace

Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs) {
  const auto head = [](const ColumnRequest& column) { return object({{"head", column.title}}); };
  return list_of(info.tables, [&](const TableRequest& table) {
    Data rows = list();
    for (const Run* run : runs) {
      const bool wanted = table.variants.empty() ||
                          std::ranges::find(table.variants, run->variant) != table.variants.end();
      if (wanted) rows.push_back(row_of(table, info, *run));
    }
    return object({{"title", table.title},
                   {"caption", table.caption},
                   {"heads", list_of(table.columns, head)},
                   {"rows", rows}});
  });
}

}  // namespace trammel::reports
