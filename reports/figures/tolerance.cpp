#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "reports/data/check_text.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr double kMinShare = 1e-8;         ///< left edge; smaller fractions are drawn here
constexpr std::size_t kManyChecks = 2000;  ///< with more checks, 5 positions per decade are drawn
constexpr double kMaxShare = 100;  ///< right edge; larger fractions and errors are drawn here

/// Checks that are drawn as points on one line of the figure: those of one case, or one check with
/// its values.
struct ToleranceRow {
  std::string label;
  std::vector<std::pair<const Run*, const Check*>> checks;
  double worst = 0;
};

/// Returns the y coordinate of the points of a row of the figure. Row 0 is at the top.
double row_y(std::size_t row) {
  return -static_cast<double>(row) - 0.72;
}

double drawn_tolerance_fraction(const Check& check) {
  if (check.verdict == Verdict::error) return kMaxShare;
  return std::clamp(difference_over_tolerance(check), kMinShare, kMaxShare);
}

bool is_shown_check(const Check& check) {
  if (check.is_known_discrepancy() || check.verdict == Verdict::not_run) return false;
  return check.verdict == Verdict::fail || check.verdict == Verdict::error ||
         (check.verdict == Verdict::pass && is_numeric(check) &&
          difference_over_tolerance(check) <= 1);  // negative controls must exceed the tolerance
}

/// Returns a row of the figure for each case, or for each check if the family has only one case.
std::vector<ToleranceRow> tolerance_rows(const std::map<std::string, std::string>& titles,
                                         const std::vector<const Run*>& runs) {
  const bool one_case = std::ranges::all_of(
      runs, [&](const Run* run) { return run->case_id == runs.front()->case_id; });
  std::vector<ToleranceRow> rows;
  for (const Run* run : runs)
    for (const Check& check : run->checks) {
      if (!is_shown_check(check)) continue;
      const std::string label = one_case ? check_title(check) : titles.at(run->case_id);
      const auto same = [&](const ToleranceRow& known) { return known.label == label; };
      ToleranceRow& row = harness::find_or_add(rows, same, {label, {}, 0});
      row.checks.emplace_back(run, &check);
      row.worst = std::max(row.worst, drawn_tolerance_fraction(check));
    }
  return rows;
}

/// Keeps the check that uses the largest fraction of its tolerance in each row, and sorts the rows
/// by this fraction.
void keep_largest_of_each_row(std::vector<ToleranceRow>& rows) {
  std::ranges::sort(rows, {}, [](const ToleranceRow& row) { return -row.worst; });
  const auto fraction = [](const auto& entry) { return drawn_tolerance_fraction(*entry.second); };
  for (ToleranceRow& row : rows) row.checks = {*std::ranges::max_element(row.checks, {}, fraction)};
}

/// Returns the points of the checks for which `belongs` returns true.
/// @param per_decade  number of distinct positions in a decade of the axis
template <typename Belongs>
PlotScript::Rows points(const std::vector<ToleranceRow>& rows, double per_decade, Belongs belongs) {
  PlotScript::Rows out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [_, check] : rows[i].checks)
      if (belongs(*check)) out.push_back({drawn_tolerance_fraction(*check), row_y(i)});
  // Points whose rounded positions are equal are drawn once.
  for (auto& point : out)
    point[0] = std::pow(10, std::round(per_decade * std::log10(point[0])) / per_decade);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::string conclusion(const std::vector<ToleranceRow>& rows) {
  std::size_t n = 0, beyond = 0;
  const ToleranceRow* worst = &rows.front();
  for (const ToleranceRow& row : rows) {
    if (row.worst > worst->worst) worst = &row;
    for (const auto& [_, check] : row.checks) {
      ++n;
      if (check->verdict != Verdict::pass) ++beyond;
    }
  }
  if (beyond > 0)
    return std::to_string(beyond) + " of " + count(n, "number") +
           " fail or could not be evaluated; the worst is in " + worst->label + ".";
  return (n == 1 ? "The number passes" : "All " + count(n, "number") + " pass") +
         "; the one nearest to its limit uses " + trimmed(100 * worst->worst, 2) +
         "\u202f% of its tolerance (" + worst->label + ").";
}

/// Sets the y axis and writes labels above the lines of their rows, so that the labels
/// need no margin.
void write_row_labels(PlotScript& script, const std::vector<ToleranceRow>& rows, bool with_labels) {
  script.command("unset ytics; set border 1; set lmargin 2; set rmargin 3");
  script.command("unset grid; set grid xtics" + lc(palette::kGrid) + " lw 1 lt 1");
  script.range("y", -static_cast<double>(rows.size()), 0);
  for (std::size_t i = 0; with_labels && i < rows.size(); ++i) {
    const std::string label =
        shortened(rows[i].label, 44) + " (" + std::to_string(rows[i].checks.size()) + ")";
    const std::string line = ", first " + shortest_decimal(-static_cast<double>(i));
    script.label(label, "graph 0.006, first " + shortest_decimal(-static_cast<double>(i) - 0.3) +
                            " left front font ',13.5' textcolor rgb '" + palette::kInk + "'");
    if (i > 0)
      script.command("set arrow from graph 0" + line + " to graph 1" + line + " nohead back lw 1" +
                     lc(palette::kGrid));
  }
}

void draw_tolerance_limits(PlotScript& script, std::size_t rows) {
  const double bottom = -static_cast<double>(rows);
  script.curve({{1, bottom}, {kMaxShare * 1.6, bottom}, {kMaxShare * 1.6, 0}, {1, 0}, {1, bottom}},
               "with filledcurves closed" + lc(palette::kBlush));
  script.curve({{1, bottom}, {1, 0}}, "with lines lw 1.5" + lc(palette::color(1)));
}

Table table_of(const std::vector<ToleranceRow>& rows) {
  Table table;
  table.digits = kSampleDigits;
  table.heads = words_in("case variant check quantity index share_of_tolerance verdict");
  for (const ToleranceRow& row : rows)
    for (const auto& [run, check] : row.checks) {
      const double used = difference_over_tolerance(*check);
      table.rows.push_back(
          {run->case_id, run->variant, check->name, check->quantity,
           check->index ? harness::Json(static_cast<double>(*check->index + 1)) : harness::Json(),
           std::isfinite(used) ? harness::Json(used) : harness::Json(), verdict_text(*check)});
    }
  return table;
}

}  // namespace

std::optional<Figure> tolerance_figure(const std::string& family,
                                       const std::map<std::string, std::string>& titles,
                                       const std::vector<const Run*>& runs, bool largest_only) {
  if (runs.empty()) return std::nullopt;
  std::vector<ToleranceRow> rows = tolerance_rows(titles, runs);
  if (rows.empty()) return std::nullopt;

  const std::string caption = conclusion(rows);
  if (largest_only) keep_largest_of_each_row(rows);
  Table table = table_of(rows);
  const bool many = table.rows.size() > kManyChecks;
  const double per_decade = many ? 5 : 100;
  PlotScript script;
  write_row_labels(script, rows, !largest_only);
  script.log_axis("x", kMinShare, kMaxShare);
  script.range("x", kMinShare / 1.6, kMaxShare * 1.6);
  script.command(
      "set xtics ('≤ 10⁻⁸' 1e-8, '10⁻⁶' 1e-6, '10⁻⁴' 1e-4, '1 %%' 1e-2, '10 %%' 1e-1, "
      "'limit' 1, '≥ 100' 1e2)");
  script.axis_label("x", "fraction of the tolerance used");
  draw_tolerance_limits(script, rows.size());
  const auto passes = [](const Check& c) { return c.verdict == Verdict::pass; };
  const std::string dot = "with points pt 7 ps 0.55";
  for (const auto& [role, color] :
       {std::pair("verification", 0U), std::pair("validation", 3U), std::pair("regression", 5U)}) {
    const auto belongs = [&, role = role](const Check& c) { return passes(c) && c.role == role; };
    script.curve(points(rows, per_decade, belongs), dot + lc(palette::color(color)), role);
  }
  script.curve(points(rows, per_decade, [&](const Check& c) { return !passes(c); }),
               "with points pt 2 ps 1 lw 2.5" + lc(palette::color(1)), "fails or error");
  script.plot();

  return Figure{.id = slug(family + "-tolerance"),
                .title = largest_only ? "Largest fraction of the tolerance in each case"
                                      : "Fraction of the tolerance used by each check",
                .caption = "Difference over tolerance; the line is the limit. " + caption,
                .alt = "Dots on a logarithmic axis, with the limit marked. " + caption,
                .height = 105 + (largest_only ? 8
                                 : many       ? 28
                                              : 40) *
                                    static_cast<int>(rows.size()),
                .commands = script.commands(),
                .data = std::move(table)};
}

}  // namespace trammel::reports
