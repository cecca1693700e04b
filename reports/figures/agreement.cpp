#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "reports/data/check_text.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMinEntries = 3, kMaxEntries = 16;

/// Checks that compare computed values of a run with the values of one published reference.
struct PrintedRow {
  std::string reference;
  std::vector<const Check*> entries;
};

std::vector<PrintedRow> printed_rows(const Run& run) {
  std::vector<PrintedRow> rows;
  for (const Check& check : run.checks) {
    const bool is_compared = check.role == "validation" && check.measure == "relative" &&
                             check.index && check.expected && check.computed && check.difference &&
                             !check.reference.empty();
    if (!is_compared || (!rows.empty() && rows[0].entries[0]->quantity != check.quantity)) continue;
    const auto same = [&](const PrintedRow& row) { return row.reference == check.reference; };
    harness::find_or_add(rows, same, PrintedRow{check.reference, {}}).entries.push_back(&check);
  }
  std::erase_if(rows, [](const PrintedRow& row) {
    return row.entries.size() < kMinEntries || row.entries.size() > kMaxEntries;
  });
  return rows;
}

/// Returns the expanded uncertainty of a computed value due to discretization and inputs, in the
/// unit of the value.
double uncertainty_of_check(const Run& run, const Check& check) {
  const Comparison* found = find_comparison(run, check);
  return found ? 2 * std::hypot(found->u_num.value_or(0), found->u_input.value_or(0)) : 0;
}

}  // namespace

std::optional<Figure> agreement_figure(const CaseInfo& info, const Results& results,
                                       const Run& run) {
  const std::vector<PrintedRow> rows = printed_rows(run);
  if (rows.empty()) return std::nullopt;
  const Check& first = *rows.front().entries.front();
  const QuantityLabel quantity = parse_quantity(first.quantity);
  PlotScript script;
  Table table{{"reference", "entry", "printed_" + first.unit, "computed_" + first.unit,
               "expanded_uncertainty_" + first.unit},
              {}};
  PlotScript::Rows computed;
  std::vector<std::string> titles;
  Interval differences;
  int last = 0;
  std::size_t reproduced = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Reference* reference = results.reference(rows[r].reference);
    const std::string title = reference ? reference->title : rows[r].reference;
    PlotScript::Rows points;
    for (const Check* check : rows[r].entries) {
      const double entry = *check->index + 1, band = uncertainty_of_check(run, *check);
      points.push_back({entry - 0.12 - 0.1 * static_cast<double>(r), *check->expected});
      if (r == 0) computed.push_back({entry + 0.12, *check->computed, band});
      differences.cover(check->difference);
      reproduced += find_status(*check) == CheckStatus::passes ? 1 : 0;
      last = std::max(last, *check->index + 1);
      table.rows.push_back({title, entry, *check->expected, *check->computed, band});
    }
    script.curve(points,
                 "with points ps 1.2 pt " + palette::open_marker(r + 1) + " lw 2" +
                     lc(palette::color(r + 1)),
                 title);
    titles.push_back(title);
  }
  script.curve(computed, "with yerrorbars ps 1 pt 7 lw 2" + lc(palette::color(0)), "computed");
  titles.emplace_back("computed");
  script.range("x", 0.5, last + 0.5);
  script.command("set xtics 1,1; set yrange [0:*]");
  const bool modes = first.quantity.starts_with("frequency");
  script.axis_label("x", modes ? "mode" : "entry");
  script.axis_label("y", axis_label(to_text(quantity), quantity.unit));
  const int key = script.place_key_below(titles);
  script.plot();
  const std::string caption =
      "Printed values, and computed values with their expanded uncertainty (discretization and "
      "inputs). The computed values differ from the printed ones (" +
      titles.front().substr(0, titles.front().find_first_of(":,")) + ") by " +
      limits_text(percent_text(differences.low, 3, true), percent_text(differences.high, 3, true)) +
      ". " + std::to_string(reproduced) + " of " + count(table.rows.size(), "printed value") +
      " are reproduced.";
  return Figure{.id = slug(info.id + "-" + run.variant + "-agreement"),
                .title = capitalized(to_text(quantity)) + ": printed and computed",
                .caption = caption,
                .alt = caption,
                .height = 330 + key,
                .commands = script.commands(),
                .data = std::move(table)};
}

}  // namespace trammel::reports
