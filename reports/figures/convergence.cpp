#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "harness/base/find_or_add.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr double kSmallestDrawnError = 1e-17;  ///< smaller errors are drawn at this value

using Sweeps = std::vector<const Convergence*>;

/// Returns the relative errors of the computed values at all refinement levels. The errors are
/// differences from the exact value or, without one, from the Richardson-extrapolated value.
Numbers errors_of_levels(const Convergence& c) {
  Numbers errors = c.error;
  const bool given = std::ranges::any_of(errors, &Number::has_value);
  if (given || !c.richardson || *c.richardson == 0) return errors;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (c.values[i]) errors[i] = std::abs(*c.values[i] / *c.richardson - 1);
  return errors;
}

double error_on_log_axis(double error) {
  return std::max(std::abs(error), kSmallestDrawnError);
}

/// Returns the largest estimate of the relative round-off error among all values at each refinement
/// level.
PlotScript::Rows roundoff_floor(const Sweeps& sweeps) {
  std::map<double, Interval> roundoff;
  for (const Convergence* c : sweeps)
    for (std::size_t i = 0; i < c->parameter.size(); ++i)
      if (c->roundoff[i].value_or(0) > 0) roundoff[*c->parameter[i]].cover(c->roundoff[i]);
  PlotScript::Rows rows;
  for (const auto& [parameter, interval] : roundoff) rows.push_back({parameter, interval.high});
  return rows;
}

/// Returns the title of a curve in the legend, with its fitted order of convergence: "mode 3:
/// 3.99".
std::string series_title(const Convergence& c, bool alone) {
  std::string title = c.quantity.starts_with("frequency") ? "mode " : "entry ";
  title = alone ? to_text(parse_quantity(c.quantity)) : title + std::to_string(c.index + 1);
  if (c.fitted_order) title += ": " + rounded_text(*c.fitted_order, 3);
  return title;
}

void draw_series(PlotScript& script, const Convergence& c, std::size_t i, bool alone,
                 Interval& extent) {
  const Numbers errors = errors_of_levels(c);
  PlotScript::Rows line, inside;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!errors[k]) continue;
    const double y = error_on_log_axis(*errors[k]);
    extent.cover(y);
    line.push_back({*c.parameter[k], y});
    if (c.in_asymptotic_range[k]) inside.push_back(line.back());
  }
  const std::string color = lc(palette::color(i));
  const std::string style = palette::open_marker(i), solid = palette::filled_marker(i);
  script.curve(line, "with linespoints lw 1.4 ps 0.8 pt " + style + color);
  script.curve(inside, "with points ps 0.8 pt " + solid + color);
  script.key_entry("with linespoints lw 1.4 ps 0.8 pt " + solid + color, series_title(c, alone));
}

/// Draws a line with the theoretical slope below the first curve with an asymptotic range, along
/// this range.
void draw_slope(PlotScript& script, const Sweeps& sweeps, double theory, Interval& extent) {
  PlotScript::Rows line;
  for (const Convergence* c : sweeps) {
    const Numbers errors = errors_of_levels(*c);
    const bool falls = errors.front().value_or(0) > errors.back().value_or(0);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (!errors[k] || !c->in_asymptotic_range[k]) continue;
      const double x = *c->parameter[k], start = error_on_log_axis(*errors[k]) / 4;
      const double way = line.empty() ? 1 : std::pow(x / line[0][0], falls ? -theory : theory);
      line.push_back({x, way * (line.empty() ? start : line[0][1])});
      extent.cover(line.back()[1]);
    }
    if (!line.empty()) break;
  }
  script.curve(line, "with lines lw 1.4 dt 2" + lc(palette::kInk), "order " + trimmed(theory, 3));
}

/// Returns a sentence on the fitted and the theoretical order of convergence. If the theoretical
/// error is a h^p + b h^q, the sentence states the misfit of this two-term law instead.
std::string order_summary(const Sweeps& sweeps) {
  const Convergence& first = *sweeps.front();
  const bool mixed = first.lower_order && first.theory_order;
  Interval orders;
  std::size_t fitted = 0;
  double misfit = 0;
  for (const Convergence* c : sweeps) {
    const bool has_law = c->two_term && c->two_term->max_relative_misfit;
    if (!(mixed ? has_law : c->fitted_order.has_value())) continue;
    ++fitted;
    orders.cover(c->fitted_order);
    if (has_law) misfit = std::max(misfit, *c->two_term->max_relative_misfit);
  }
  const std::string which = sweeps.size() == 1
                                ? "The error"
                                : std::to_string(fitted) + " of " + count(sweeps.size(), "curve");
  const auto is_asymptotic = [](const Convergence* c) {
    return harness::contains(c->in_asymptotic_range, true);
  };
  if (fitted == 0)
    return std::ranges::any_of(sweeps, is_asymptotic)
               ? "Too few refinement levels lie in the asymptotic range to fit an order."
               : "No refinement level lies in the asymptotic range.";
  if (mixed)
    return which + " follows the law a h^" + trimmed(*first.theory_order, 3) + " + b h^" +
           trimmed(*first.lower_order, 3) + ", with the mesh or step size h, within " +
           reports::percent_text(misfit, 2, false) + ".";
  return which + (fitted == 1 ? " falls" : " fall") + " with order " +
         limits_text(rounded_text(orders.low, 3), rounded_text(orders.high, 3)) +
         (first.theory_order ? "; theory: " + trimmed(*first.theory_order, 3) : "") + ".";
}

Table table_of_sweeps(const Sweeps& sweeps) {
  Table table;
  table.heads = {sweeps.front()->sweep,    "index",
                 sweeps.front()->quantity, "relative_error",
                 "relative_roundoff",      "pairwise_order",
                 "in_asymptotic_range",    "relative_uncertainty_band"};
  for (const Convergence* c : sweeps) {
    const Numbers errors = errors_of_levels(*c);
    for (std::size_t k = 0; k < c->parameter.size(); ++k)
      table.rows.push_back(
          {*c->parameter[k], static_cast<double>(c->index + 1), number_or_null(c->values[k]),
           number_or_null(errors[k]), number_or_null(c->roundoff[k]), number_or_null(c->order[k]),
           std::string(c->in_asymptotic_range[k] ? "yes" : "no"), number_or_null(c->gci[k])});
  }
  return table;
}

void set_parameter_axis(PlotScript& script, const Sweeps& sweeps) {
  std::set<double> levels;
  for (const Convergence* c : sweeps)
    for (const Number& level : c->parameter) levels.insert(*level);
  script.command("set logscale x");
  script.range("x", *levels.begin() / 1.3, *levels.rbegin() * 1.3);
  std::string tics;
  const std::size_t step = (levels.size() + 8) / 9;
  std::size_t i = 0;
  for (const double level : levels)
    if (i++ % step == 0) add_item(tics, tic(trimmed(level, 3), level));
  script.command("set xtics (" + tics + ")");
  const QuantityLabel parameter = parse_quantity(sweeps.front()->sweep);
  script.axis_label("x", axis_label(parameter.label, parameter.unit));
}

Figure figure_of_sweeps(const CaseInfo& info, const Run& run, const Sweeps& sweeps) {
  const Convergence& first = *sweeps.front();
  const bool exact = std::ranges::any_of(first.error, &Number::has_value);
  PlotScript script;
  set_parameter_axis(script, sweeps);
  const std::string words = to_text(parse_quantity(first.quantity));
  script.axis_label("y", exact ? "relative error of " + words
                               : "distance of " + words + " from extrapolated value");
  Interval extent{1, 1e-16};
  std::vector<std::string> titles = {"round-off", "order of theory"};
  for (const Convergence* c : sweeps) titles.push_back(series_title(*c, sweeps.size() == 1));
  const int key_height = script.place_key_below(titles);
  const auto floor = roundoff_floor(sweeps);
  for (const auto& row : floor) extent.cover(0.3 * row[1]);
  script.curve(floor, "with filledcurves y1=1e-30" + lc(palette::kShade), "round-off");
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    draw_series(script, *sweeps[i], i, sweeps.size() == 1, extent);
  if (first.theory_order.value_or(0) > 0) draw_slope(script, sweeps, *first.theory_order, extent);
  script.log_axis("y", extent.low, extent.high);
  script.plot();

  const std::string parameter = parse_quantity(first.sweep).label, result = order_summary(sweeps);
  return {.id = slug(info.id + "-" + run.variant + "-" + first.sweep + "-" + first.quantity),
          .title = titled("Convergence of " + words + " over " + parameter, info, run),
          .caption =
              "Error against " + parameter +
              ". Filled marks lie in the asymptotic range, and the gray area is round-off error. " +
              (exact ? ""
                     : "Without an exact value, errors are distances from the "
                       "Richardson-extrapolated value. ") +
              result,
          .alt = "Error against " + parameter + " on logarithmic axes. " + result,
          .height = 360 + key_height,
          .commands = script.commands(),
          .data = table_of_sweeps(sweeps)};
}

}  // namespace

std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run) {
  std::vector<Sweeps> groups;
  for (const Convergence& c : run.convergence) {
    if (c.parameter.empty()) continue;
    // A quantity that is exact on every mesh, such as a count, has no curve.
    const Numbers errors = errors_of_levels(c);
    const auto nonzero = std::ranges::count_if(errors, [](const auto& e) { return e && *e != 0; });
    if (nonzero < 2) continue;
    const auto same = [&](const Sweeps& known) {
      return known.front()->sweep == c.sweep && known.front()->quantity == c.quantity;
    };
    harness::find_or_add(groups, same, Sweeps{}).push_back(&c);
  }
  std::vector<Figure> figures;
  for (const Sweeps& sweeps : groups) figures.push_back(figure_of_sweeps(info, run, sweeps));
  return figures;
}

}  // namespace trammel::reports
