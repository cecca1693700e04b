#include "reports/figures/discrepancy.h"

#include <algorithm>

#include "harness/base/find_or_add.h"
#include "reports/data/check_status.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/figures/strip.h"
#include "reports/text/number.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxDigits = 9;  ///< entries of a row that can be told apart by digits

/// Checks of the same name and measure over all runs of a case.
struct DiscrepancySubject {
  std::string name, measure;
  std::vector<CheckGroup> rows;
};

std::vector<DiscrepancySubject> subjects(const std::vector<const Run*>& runs) {
  std::vector<DiscrepancySubject> out;
  for (const Run* run : runs) {
    for (CheckGroup& group : group_checks(*run)) {
      const Check& check = group.front();
      const bool expected = std::ranges::any_of(
          group.checks, [](const Check* entry) { return entry->known_discrepancy(); });
      if (!expected || !check.tolerance) continue;
      const auto same = [&](const DiscrepancySubject& known) {
        return known.name == check.name && known.measure == check.measure;
      };
      auto& subject = harness::find_or_add(out, same, {check.name, check.measure, {}});
      subject.rows.push_back(std::move(group));
    }
  }
  return out;
}

bool by_digits(const CheckGroup& group) {
  return group.checks.size() > 1 && group.checks.size() <= kMaxDigits;
}

Interval extent(const DiscrepancySubject& subject, double origin) {
  Interval span{origin, origin};
  for (const CheckGroup& row : subject.rows)
    for (const Check* check : row.checks) {
      span.cover(check->difference);
      span.cover(check->tolerance->low);
      span.cover(check->tolerance->high);
    }
  span.widen(std::max(0.06 * span.length(), 1e-12));
  return span;
}

PlotScript::Rows box(double x0, double x1, std::size_t row) {
  const double y = strip_y(row);
  return {{x0, y - 0.23}, {x1, y - 0.23}, {x1, y + 0.23}, {x0, y + 0.23}, {x0, y - 0.23}};
}

/// The bands of a row; one that is too narrow to be seen is drawn as wide as a digit.
PlotScript::Rows tolerance_bars(const CheckGroup& group, std::size_t row, double factor,
                                const Interval& span) {
  const double min_width = 0.022 * span.length();
  PlotScript::Rows rows;
  for (const Check* check : group.checks) {
    double low = check->tolerance->low.value_or(span.low);
    double high = check->tolerance->high.value_or(span.high);
    const double more = 0.5 * std::max(0.0, min_width - (high - low));
    low = factor * (low - more);
    high = factor * (high + more);
    if (!rows.empty()) rows.emplace_back();
    for (auto& corner : box(low, high, row)) rows.push_back(std::move(corner));
  }
  return rows;
}

/// Entries as digits where they stand; those that would fall on each other one higher, one lower.
void draw_digits(PlotScript& script, const CheckGroup& group, std::size_t row, double factor,
                 const Interval& span) {
  std::vector<const Check*> order;
  for (const Check* check : group.checks)
    if (check->difference) order.push_back(check);
  std::ranges::stable_sort(
      order, [](const Check* a, const Check* b) { return *a->difference < *b->difference; });
  const double near = 0.02 * span.length();
  const auto distance = [&](std::size_t i) {
    return *order[i]->difference - *order[i - 1]->difference;
  };
  bool high = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool crowded =
        (i > 0 && distance(i) < near) || (i + 1 < order.size() && distance(i + 1) < near);
    high = crowded && !high;
    const double y = strip_y(row) + (crowded ? (high ? 0.13 : -0.13) : 0);
    const bool pass = order[i]->verdict == Verdict::pass;
    script.label(std::to_string(order[i]->index.value_or(0) + 1),
                 shortest(factor * *order[i]->difference) + "," + shortest(y) +
                     " center front font ',12.5' textcolor rgb '" + palette::color(pass ? 0 : 1) +
                     "'");
  }
}

void draw_row(PlotScript& script, const CheckGroup& group, std::size_t row, double factor,
              const Interval& span) {
  script.curve(tolerance_bars(group, row, factor, span),
               "with filledcurves closed" + lc(palette::kAmber), row == 0 ? "expected" : "");
  if (by_digits(group)) return draw_digits(script, group, row, factor, span);
  PlotScript::Rows good, bad;
  for (const Check* check : group.checks) {
    if (!check->difference) continue;
    const double x = factor * *check->difference;
    (check->verdict == Verdict::pass ? good : bad).push_back({x, strip_y(row)});
  }
  script.curve(good, "with points pt 7 ps 0.7" + lc(palette::color(0)));
  script.curve(bad, "with points pt 2 ps 1 lw 2.5" + lc(palette::color(1)));
}

std::string words(double x, const std::string& measure) {
  return measure == "relative" ? relative(x, 3, true) : trimmed(x, 4);
}

std::string conclusion(const DiscrepancySubject& subject) {
  Interval span;
  std::size_t n = 0, outside = 0;
  for (const CheckGroup& row : subject.rows)
    for (const Check* check : row.checks) {
      span.cover(check->difference);
      ++n;
      if (check->verdict != Verdict::pass) ++outside;
    }
  if (span.empty()) return "No difference could be computed.";
  std::string text = n == 1 ? "The difference is " + words(span.low, subject.measure)
                            : "The " + count(n, "difference") + " lie between " +
                                  words(span.low, subject.measure) + " and " +
                                  words(span.high, subject.measure);
  text += outside == 0 ? ", as the record of the discrepancy expects."
                       : "; " + std::to_string(outside) + " outside what the record expects.";
  return text;
}

Table table_of(const DiscrepancySubject& subject, const CaseInfo& info) {
  Table table;
  const std::string unit = subject.measure == "relative" || subject.measure == "ratio"
                               ? "_" + subject.measure
                               : "_" + subject.rows.front().front().unit;
  table.heads = words_in("case variant title quantity index computed expected unit");
  for (const char* name : {"difference", "recorded_low", "recorded_high"})
    table.heads.push_back(name + unit);
  table.heads.emplace_back("verdict");
  for (const CheckGroup& row : subject.rows)
    for (const Check* check : row.checks)
      table.rows.push_back({info.id, row.run->variant, info.variant_title(row.run->variant),
                            check->quantity, static_cast<double>(check->index.value_or(0) + 1),
                            cell(check->computed), cell(check->expected), check->unit,
                            cell(check->difference), cell(check->tolerance->low),
                            cell(check->tolerance->high), to_string(check->verdict)});
  return table;
}

Figure figure_of(const CaseInfo& info, const Results& results, const DiscrepancySubject& subject) {
  const bool percent = subject.measure == "relative";
  const double factor = percent ? 100 : 1;
  const double origin = subject.measure == "ratio" ? 1 : 0;
  const Interval span = extent(subject, origin);
  PlotScript script;
  std::vector<std::string> labels;
  for (const CheckGroup& row : subject.rows) labels.push_back(info.variant_title(row.run->variant));
  strip_rows(script, labels);
  script.range("x", factor * span.low, factor * span.high);
  const Check& first = subject.rows.front().front();
  const std::string unit = percent ? "%" : (subject.measure == "absolute" ? first.unit : "");
  const std::string what = subject.measure == "ratio" ? "ratio" : "computed minus target";
  script.axis_label("x", unit.empty() ? what : what + " (" + unit + ")");
  for (std::size_t i = 0; i < subject.rows.size(); ++i)
    draw_row(script, subject.rows[i], i, factor, span);
  PlotScript::Rows agreement;  // below the labels of the rows, which it would strike through
  for (std::size_t i = 0; i < subject.rows.size(); ++i) {
    const double top = -static_cast<double>(i);
    agreement.insert(agreement.end(),
                     {{factor * origin, top - 1}, {factor * origin, top - 0.5}, {}});
  }
  script.curve(agreement, "with lines lw 1.5" + lc(palette::kInk), percent ? "agreement" : "");
  script.plot();

  const Reference* reference = results.reference(first.reference);
  std::string caption = conclusion(subject);
  const bool modes = first.quantity.starts_with("frequency");
  if (std::ranges::any_of(subject.rows, by_digits))
    caption += std::string(" Digits number the ") + (modes ? "modes." : "entries.");
  return {.id = slug(info.id + "-" + subject.name + "-" + subject.measure + "-discrepancy"),
          .title = "Does not agree: " + (!first.title.empty() ? first.title
                                         : reference          ? reference->title
                                                              : subject.name),
          .caption = caption,
          .alt = "Differences of every variant with the recorded range. " + caption,
          .height = strip_height(subject.rows.size()) + 20,
          .commands = script.commands(),
          .data = table_of(subject, info)};
}

}  // namespace

std::vector<Figure> discrepancy_figures(const CaseInfo& info, const Results& results,
                                        const std::vector<const Run*>& runs) {
  std::vector<Figure> figures;
  for (const DiscrepancySubject& subject : subjects(runs)) {
    // A lone difference is said by its row in the table.
    if (subject.rows.size() == 1 && subject.rows.front().checks.size() == 1) continue;
    figures.push_back(figure_of(info, results, subject));
  }
  return figures;
}

}  // namespace trammel::reports
