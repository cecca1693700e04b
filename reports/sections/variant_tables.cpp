#include "reports/sections/variant_tables.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// As the cases' schema names them; empty where a value is missing.
Number statistic(const std::string& name, const Numbers& numbers) {
  std::vector<double> values;
  for (const Number& number : numbers) {
    if (!number) return std::nullopt;
    values.push_back(*number);
  }
  if (values.empty()) return std::nullopt;
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto n = static_cast<double>(values.size());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  if (name.empty() || name == "first") return values.front();
  if (name == "last") return values.back();
  if (name == "max") return *highest;
  if (name == "min") return *lowest;
  if (name == "range") return *highest - *lowest;
  if (name == "max_abs") return std::abs(*std::ranges::max_element(values, smaller));
  if (name == "min_abs") return std::abs(*std::ranges::min_element(values, smaller));
  if (name == "sum") return sum;
  if (name == "mean") return sum / n;
  if (name == "rms")
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / n);
  return std::nullopt;
}

Number timing_of(const Run& run, const std::string& name) {
  for (const auto& [key, seconds, evaluations] : run.cost.timings)
    if (key == name) return seconds;
  return std::nullopt;
}

std::string cell_text(const ColumnRequest& column, const Run& run) {
  if (column.timing.empty()) {
    const Numbers* numbers = run.quantity(column.quantity);
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
  Data row = object();
  row.set("variant", info.variant_title(run.variant));
  Data cells = list();
  for (const ColumnRequest& column : table.columns) {
    Data cell = object();
    cell.set("value", cell_text(column, run));
    cells.push_back(cell);
  }
  row.set("cells", cells);
  return row;
}

}  // namespace

Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const TableRequest& table : info.tables) {
    Data data = object();
    data.set("title", table.title);
    data.set("caption", table.caption);
    Data heads = list();
    for (const ColumnRequest& column : table.columns) {
      Data head = object();
      head.set("head", column.title);
      heads.push_back(head);
    }
    data.set("heads", heads);
    Data rows = list();
    for (const Run* run : runs) {
      const bool wanted = table.variants.empty() ||
                          std::ranges::find(table.variants, run->variant) != table.variants.end();
      if (wanted) rows.push_back(row_of(table, info, *run));
    }
    data.set("rows", rows);
    out.push_back(data);
  }
  return out;
}

}  // namespace trammel::reports
