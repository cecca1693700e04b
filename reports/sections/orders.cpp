#include "harness/base/find_or_add.h"
#include "reports/drawing/interval.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

/// Convergence of all values of one quantity in one refinement study (sweep) of one run.
using OrderRow = std::vector<const Convergence*>;

std::vector<OrderRow> rows_of(const Run& run) {
  std::vector<OrderRow> rows;
  for (const Convergence& c : run.convergence) {
    const auto same = [&](const OrderRow& row) {
      return row.front()->sweep == c.sweep && row.front()->quantity == c.quantity;
    };
    harness::find_or_add(rows, same, {}).push_back(&c);
  }
  return rows;
}

/// Summary of the orders of convergence and of the errors, for one table row or for all rows of a
/// family.
struct Findings {
  std::size_t rows = 0, entries = 0;
  Interval order, law;  ///< fitted orders; relative misfits of two-term laws

  void add(const OrderRow& row) {
    ++rows;
    for (const Convergence* c : row) add(*c);
  }
  void add(const Convergence& c) {
    ++entries;
    if (c.two_term) law.cover(c.two_term->max_relative_misfit);
    if (!c.lower_order) order.cover(c.fitted_order);
  }
};

std::string theory_text(const Convergence& c) {
  if (!c.theory_order) return "–";
  const std::string order = trimmed(*c.theory_order, 4);
  return c.lower_order ? order + " and " + trimmed(*c.lower_order, 4) : order;
}

std::string observed_text(const Findings& findings) {
  if (!findings.law.empty())
    return "two-term law within " + percent_text(findings.law.high, 2, false);
  if (findings.order.empty()) return "–";
  return limits_text(trimmed(findings.order.low, 3), trimmed(findings.order.high, 3));
}

std::vector<std::string> cells_of(const OrderRow& row, const std::string& variant) {
  Findings findings;
  findings.add(row);
  std::string quantity = to_text(parse_quantity(row.front()->quantity));
  if (row.size() > 1) quantity += ", " + count(row.size(), "entry", "entries");
  if (!variant.empty()) quantity += "; " + variant;
  return {quantity, theory_text(*row.front()), observed_text(findings)};
}

std::string conclusion_of_findings(const Findings& all) {
  std::string text = "Summary of " + count(all.entries, "refinement") + ".";
  if (!all.law.empty())
    text += " If the error has terms of two orders, the sum of both terms fits it within " +
            percent_text(all.law.high, 2, false) + ".";
  return text;
}

Data order_data_of_family(const Family& family, Findings& all) {
  TextTable table{family.title, {"Quantity", ">Order by theory", ">Observed"}};
  for (const CaseInfo* info : family.cases) {
    const std::size_t before = table.rows.size();
    for (const Run* run : family.runs_of(info->id)) {
      const std::string variant = run->variant == "base" ? "" : info->variant_title(run->variant);
      for (const OrderRow& row : rows_of(*run)) {
        all.add(row);
        table.rows.push_back(cells_of(row, variant));
      }
    }
    if (table.rows.size() == before) continue;
    const std::string title = family.short_title(*info);
    table.rows.emplace(table.rows.begin() + static_cast<std::ptrdiff_t>(before), 1, title);
    table.links[title] = case_link(info->id);
  }
  table.caption = conclusion_of_findings(all);
  Data data = table_data(table);
  set(data, {{"folded_title", count(all.rows, "row")}});
  return data;
}

}  // namespace

Data convergence_section(const Results& results, const std::vector<Family>& families,
                         const StudyFigures& figures) {
  Data shown = list();
  std::size_t entries = 0;
  for (const Family& family : families) {
    Findings all;
    const Data data = order_data_of_family(family, all);
    if (all.rows > 0) shown.push_back(data);
    entries += all.entries;
  }
  std::string text;
  if (results.uncertainty_coverage && results.uncertainty_coverage->levels > 0) {
    const UncertaintyCoverage& found = *results.uncertainty_coverage;
    text = "The numerical uncertainty (GCI) covers the exact value on " +
           std::to_string(found.covered) + " of " + std::to_string(found.levels) + " levels (" +
           percent_text(1.0 * found.covered / found.levels, 3, false) + ")" +
           (found.median_ratio
                ? "; median GCI: " + trimmed(*found.median_ratio, 3) + " times the true error."
                : ".");
  }
  return object({{"has_rows", entries > 0},
                 {"words", "Theoretical and observed orders of " +
                               count(entries, "refined quantity", "refined quantities") + "."},
                 {"coverage", text},
                 {"figures", list_of(figures.trust, figure_data)},
                 {"families", shown}});
}

}  // namespace trammel::reports
