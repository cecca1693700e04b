#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr double kSmallestDrawnChange = 1e-9;  ///< smaller relative changes are drawn here
constexpr double kSceneMargin = 1.3;           ///< ratio of axis limits to outermost points

Table table_of(const std::vector<EffectScene>& scenes) {
  Table table{words_in("scene analysis tolerance change"), {}};
  for (const EffectScene& s : scenes)
    table.rows.push_back({s.scene, s.analysis, s.tolerance, s.change});
  return table;
}

/// Returns sentences on the automatic selection of effects in all scenes (cases with candidate
/// effects). The sentences state the number of scenes within the tolerance, the number without a
/// superfluous effect, and the computing time relative to runs with all effects.
std::string conclusion(const std::vector<EffectScene>& scenes) {
  std::size_t within = 0, minimal = 0;
  double all_effects_s = 0, selected_s = 0;
  for (const EffectScene& scene : scenes) {
    if (scene.change <= scene.tolerance) ++within;
    if (scene.minimal) ++minimal;
    all_effects_s += scene.whole_s;
    selected_s += scene.deciding_s + scene.chosen_s;
  }
  return std::to_string(within) + " of " + count(scenes.size(), "scene") +
         " stay within the tolerance (below the line). In " + std::to_string(minimal) +
         ", no selected effect can be omitted. Selection and run took " +
         trimmed(all_effects_s > 0 ? selected_s / all_effects_s : 0, 3) +
         " times as long as running with all effects.";
}

/// Returns the caption of the figure of work and time of the calls of the program trammel.
/// @param work, time  rows of (call, value relative to the first call)
std::string caption_of(const PlotScript::Rows& work, const PlotScript::Rows& time) {
  const auto last = [](const PlotScript::Rows& rows) { return trimmed(rows.back()[1], 3); };
  std::string text =
      "Counted work and processor time of all runs of each call of trammel, relative to the first "
      "call. Times are of calls that computed all runs, on the machine of the newest call.";
  if (!work.empty()) text += " The newest call has " + last(work) + " times the work";
  if (time.size() > 1)
    text += (work.empty() ? " The newest call has " : " and ") + last(time) + " times the time";
  return text + (work.empty() && time.size() < 2 ? "" : ".");
}

/// Draws sets of points, and the line y = x.
/// @param line  title of the line y = x
/// @param log   true for logarithmic axes
Figure scatter(Figure figure, const std::map<std::string, PlotScript::Rows>& curves,
               const std::string& x_label, const std::string& y_label, const std::string& line,
               bool log = true) {
  Interval x{1, 0}, y{1, 0};
  PlotScript script;
  std::vector<std::string> keys = {line};
  for (const auto& [title, rows] : curves) {
    for (const std::vector<double>& point : rows) {
      x.cover_around(point[0], kSceneMargin);
      y.cover_around(point[1], kSceneMargin);
    }
    script.curve(rows,
                 "using 1:2 with points ps 0.7 pt " + palette::filled_marker(keys.size() - 1) +
                     lc(palette::color(keys.size() - 1)),
                 title);
    keys.push_back(title);
  }
  y.high = std::max(x.high, y.high);
  if (log) script.log_axis("x", x.low, x.high), script.log_axis("y", y.low, y.high);
  script.axis_label("x", x_label);
  script.axis_label("y", y_label);
  script.curve({{x.low, x.low}, {x.high, x.high}},
               "using 1:2 with lines lw 1.5 dt 2" + lc(palette::kMuted), line);
  figure.height = 350 + script.place_key_below(keys);
  script.plot();
  figure.alt = figure.caption;
  figure.commands = script.commands();
  figure.is_linked = true;
  return figure;
}

}  // namespace

std::optional<Figure> effects_figure(const CaseInfo& info, const Results& results, const Run& run) {
  PlotScript::Rows kept, omitted, cumulative;
  std::string tics, on, off;
  double y = 0, largest = 1e-2;
  Table table{words_in("effect state change_without_it cumulative_change"), {}};
  for (const EffectRow& effect : run.effects) {
    if (!effect.own_change) continue;
    const double change = std::max(*effect.own_change, kSmallestDrawnChange);
    add_item(tics, tic(replace_separators(effect.name), --y), ",");
    (effect.active ? kept : omitted)
        .push_back({change, y, kSmallestDrawnChange, change, y - 0.3, y + 0.3});
    add_item(effect.active ? on : off, replace_separators(effect.name) + " (" +
                                           percent_text(*effect.own_change, 2, false) + ")");
    const double sum = std::max(effect.cumulative_change.value_or(0), kSmallestDrawnChange);
    if (effect.cumulative_change) cumulative.push_back({sum, y});
    largest = std::max({largest, change, sum});
    table.rows.push_back({effect.name, std::string(effect.active ? "on" : "off"),
                          number_or_null(effect.own_change),
                          number_or_null(effect.cumulative_change)});
  }
  if (table.rows.empty()) return std::nullopt;
  PlotScript script;
  script.log_axis("x", kSmallestDrawnChange, largest);
  script.range("y", y - 0.6, -0.4);
  script.command("set ytics (" + tics + ")");
  script.axis_label("x", "relative change");
  const std::string boxes = "using 1:2:3:4:5:6 with boxxyerror lw 1.5" + lc(palette::color(0));
  script.curve(kept, boxes + " fs solid", "kept");
  script.curve(omitted, boxes + " fs empty", "omitted");
  script.curve(cumulative, "with points pt 5 ps 0.9" + lc(palette::color(1)), "cumulative");
  std::string caption = (on.empty() ? "No measured effect is kept." : "Kept: " + on + ".") +
                        (off.empty() ? "" : " Omitted: " + off + ".");
  const auto scene = std::ranges::find(results.effect_scenes, info.id, &EffectScene::scene);
  if (scene != results.effect_scenes.end()) {
    script.curve({{scene->tolerance, y - 0.6}, {scene->tolerance, -0.4}},
                 "with lines lw 1.5 dt 2" + lc(palette::kMuted), "tolerance");
    caption += " Permitted change " + percent_text(scene->tolerance, 2, false) + ", obtained " +
               percent_text(scene->change, 2, false) + ".";
  }
  // The key has only two columns, because the names of the effects reduce the width of the plot.
  const int key = script.place_key_below({"kept", "omitted", "cumulative", "tolerance"}, 2);
  script.plot();
  return Figure{
      .id = slug(info.id + "-" + run.variant + "-effects"),
      .title = titled("Effects", info, run),
      .caption = "Changes of results without one or several (cumulative) effects. " + caption,
      .alt = caption,
      .height = 120 + 34 * static_cast<int>(table.rows.size()) + key,
      .commands = script.commands(),
      .data = std::move(table)};
}

std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes) {
  if (scenes.empty()) return {};
  std::map<std::string, PlotScript::Rows> curves;
  for (const EffectScene& scene : scenes)
    curves[scene.analysis].push_back(
        {scene.tolerance, std::max(scene.change, kSmallestDrawnChange)});
  return {scatter({.id = "effects-obtained",
                   .title = "Automatic selection of effects: obtained change against tolerance",
                   .caption = "Change of the results caused by omitting effects, against the "
                              "requested tolerance, one point per scene. " +
                              conclusion(scenes),
                   .data = table_of(scenes)},
                  curves, "tolerance: requested limit of the change", "obtained change",
                  "tolerance")};
}

Figure error_coverage_figure() {
  PlotScript::Rows points;
  Table table{words_in("true_error stated_error"), {}};
  std::istringstream tenths(template_text("error_coverage.csv"));
  for (double truth = 0, stated = 0; tenths >> truth >> stated;)
    points.push_back({std::pow(10, truth / 10), std::pow(10, stated / 10)});
  for (const std::vector<double>& point : points) table.rows.push_back({point[0], point[1]});
  return scatter({.id = "error-coverage",
                  .title = "Stated against true discretization errors",
                  .caption = "Stated against true errors in the catalogue, rounded to fifths of "
                             "decades. Above the line, the stated error covers the true error.",
                  .data = std::move(table)},
                 {{"errors", points}}, "true error", "stated error", "stated = true");
}

std::optional<Figure> order_figure(const std::vector<const Run*>& runs) {
  std::set<std::vector<double>> places;
  int near = 0;
  Table table{words_in("case variant refinement quantity theory fitted"), {}};
  for (const Run* run : runs)
    for (const Convergence& c : run->convergence) {
      if (!c.fitted_order || !c.theory_order || c.lower_order) continue;
      const double theory = *c.theory_order, fitted = *c.fitted_order;
      places.insert({theory, std::round(20 * fitted) / 20});
      if (std::abs(fitted - theory) <= 0.1 * std::max(1.0, theory)) ++near;
      table.rows.push_back({run->case_id, run->variant, c.sweep, c.quantity, theory, fitted});
    }
  if (places.empty()) return std::nullopt;
  return scatter({.id = "orders-fitted",
                  .title = "Fitted against theoretical orders of convergence",
                  .caption = std::to_string(near) + " of " + count(table.rows.size(), "order") +
                             " lie within 10\u202f% of theory (the line).",
                  .data = std::move(table)},
                 {{"refinements", {places.begin(), places.end()}}}, "order by theory",
                 "fitted order", "fitted = theory", false);
}

Figure call_history_figure(const History& history) {
  const std::string machine = history.calls.back().machine;
  PlotScript::Rows time, work, failing;
  double first_time = 0, first_work = 0;
  Table table;
  table.heads = words_in("call date commit runs checks failures cpu_s work");
  for (const HistoryCall& call : history.calls) {
    const auto number = static_cast<double>(call.id);
    const auto counted = static_cast<double>(call.work);
    const bool is_timed = call.cpu_s > 0 && call.machine == machine;
    if (is_timed && first_time == 0) first_time = call.cpu_s;
    if (first_work == 0) first_work = counted;
    if (is_timed) time.push_back({number, call.cpu_s / first_time});
    if (first_work > 0) work.push_back({number, counted / first_work});
    if (!call.has_passed()) failing.push_back({number, first_work > 0 ? counted / first_work : 1});
    table.rows.push_back({number, call.date, call.commit, static_cast<double>(call.runs),
                          static_cast<double>(call.checks), static_cast<double>(call.failures),
                          call.cpu_s, counted});
  }
  PlotScript script;
  script.axis_label("x", "call");
  script.axis_label("y", "relative to the first call");
  const std::size_t step = std::max<std::size_t>(history.calls.size() / 8, 1);  // tick spacing >= 1
  script.command("set yrange [0:*]; set xtics " + std::to_string(history.calls.front().id) + "," +
                 std::to_string(step));
  script.range("x", static_cast<double>(history.calls.front().id) - 0.5,
               static_cast<double>(history.calls.back().id) + 0.5);
  const int key = script.place_key_below({"counted work", "processor time", "with failures"});
  const std::string line = "with linespoints lw 1.6 ps 0.8 pt ";
  script.curve(work, line + "7" + lc(palette::color(0)), "counted work");
  script.curve(time, line + "5" + lc(palette::color(1)), "processor time");
  script.curve(failing, "with points lw 2 ps 1.6 pt 2" + lc(palette::kInk), "with failures");
  script.plot();
  return {.id = "history",
          .title = "Work and time of the calls",
          .caption = caption_of(work, time),
          .alt = "Curves of counted work and processor time over the calls.",
          .height = 260 + key,
          .commands = script.commands(),
          .data = std::move(table)};
}

}  // namespace trammel::reports
