#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr double kSmallestDrawnCostError = 1e-16;  ///< smaller errors are drawn at this value
constexpr double kMargin = 1.3;                    ///< ratio of axis limits to outermost points

double drawn_error(const CostStudy& study, const CostSetting& setting) {
  return std::max(study.error_of(setting).value_or(0), kSmallestDrawnCostError);
}

bool is_drawn_setting(const CostStudy& study, const CostSetting& setting) {
  return setting.is_measured() && study.error_of(setting) && setting.relative;
}

Interval errors_of(const CostStudy& study) {
  Interval errors;
  for (const CostSetting& setting : study.settings)
    if (is_drawn_setting(study, setting)) errors.cover_around(drawn_error(study, setting), kMargin);
  if (errors.empty()) errors.cover_around(1, kMargin);
  return errors;
}

Interval time_range_of_study(const CostStudy& study) {
  Interval times;
  for (const CostSetting& setting : study.settings)
    if (setting.relative.value_or(0) > 0) times.cover_around(*setting.relative, kMargin);
  return times;
}

/// Returns the first setting of each curve. A setting is a model with one value of a numerical
/// parameter, such as the number of elements. The settings of a curve differ only in this value.
std::vector<const CostSetting*> first_settings_of_curves(const CostStudy& study) {
  std::vector<const CostSetting*> curves;
  for (const CostSetting& setting : study.settings) {
    const auto same = [&](const CostSetting* first) { return first->curve == setting.curve; };
    harness::find_or_add(curves, same, &setting);
  }
  return curves;
}

/// Returns the Pareto front as steps: the time of the cheapest setting for each permitted error.
/// @param right  largest error, at which the last step ends
PlotScript::Rows pareto_front_steps(const CostStudy& study, double right) {
  std::vector<std::pair<double, double>> front;
  for (const CostSetting& setting : study.settings)
    if (setting.pareto_optimal && is_drawn_setting(study, setting))
      front.emplace_back(drawn_error(study, setting), *setting.relative);
  std::sort(front.rbegin(), front.rend());
  PlotScript::Rows rows;
  for (const auto& [error, time] : front) {
    rows.push_back({rows.empty() ? right : rows.back()[0], time});
    rows.push_back({error, time});
  }
  return rows;
}

/// Draws the curve of computing time against error for all settings of one curve of the cost study.
/// @param first  first setting of the curve
void draw_curve(PlotScript& script, const CostStudy& study, const CostSetting& first,
                std::size_t number) {
  PlotScript::Rows points;
  for (const CostSetting& setting : study.settings) {
    if (setting.curve != first.curve || !is_drawn_setting(study, setting)) continue;
    const double time = *setting.relative;
    points.push_back({drawn_error(study, setting), time,
                      setting.time ? setting.time->relative_low : time,
                      setting.time ? setting.time->relative_high : time});
  }
  const std::string color = lc(palette::color(number));
  const bool filled = number < palette::kFilledPoint.size();
  const std::string mark = filled ? palette::filled_marker(number) : palette::open_marker(number);
  script.curve(points, "using 1:2 with lines lw 1.2" + color);
  script.curve(points, "using 1:2:3:4 with yerrorbars lw 1.2 ps 0.8 pt " + mark + color);
  script.key_entry("with linespoints lw 1.2 ps 0.8 pt " + mark + color, first.curve_title);
}

Table table_of(const CostStudy& study) {
  Table table;
  table.heads = words_in(
      "setting curve value status reason error_max error_rms error_mean cpu_s relative_time "
      "relative_time_low relative_time_high pareto_optimal");
  for (const auto& counter : study.settings.front().counters) table.heads.push_back(counter.first);
  for (const CostSetting& s : study.settings) {
    const ErrorNorms errors = s.errors.value_or(ErrorNorms{});
    std::vector<harness::Json> row = {s.title, s.curve, number_or_null(s.value), s.status,
                                      s.reason};
    const Number low = s.time ? s.time->relative_low : Number();
    const Number high = s.time ? s.time->relative_high : Number();
    for (const Number& x :
         {errors.max, errors.rms, errors.mean, Number(s.cpu_s), s.relative, low, high})
      row.push_back(number_or_null(x));
    row.emplace_back(std::string(s.pareto_optimal ? "yes" : "no"));
    for (const auto& counter : s.counters) row.emplace_back(static_cast<double>(counter.second));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Figure cost_figure(const CostStudy& study) {
  PlotScript script;
  const Interval errors = errors_of(study), times = time_range_of_study(study);
  const auto outside =
      static_cast<std::size_t>(std::ranges::count_if(study.settings, &CostSetting::has_no_result));
  script.log_axis("x", errors.low, errors.high);
  script.log_axis("y", times.low, times.high);
  const double high = std::pow(10, std::ceil(std::log10(errors.high) - 1e-9));
  script.axis_label("x", "relative error (" + study.norm + ")");
  script.axis_label("y", "time, relative to the baseline");
  script.curve(pareto_front_steps(study, high), "using 1:2 with lines lw 5" + lc(palette::kPlate),
               "Pareto front");
  const std::vector<const CostSetting*> curves = first_settings_of_curves(study);
  std::vector<std::string> keys = {"Pareto front"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    draw_curve(script, study, *curves[i], i);
    keys.push_back(curves[i]->curve_title);
  }
  const int key_height = script.place_key_below(keys);
  script.plot();
  const std::string note = " Not drawn: " + count(outside, "setting") + " without a result.";
  return {.id = slug("cost-" + study.id),
          .title = study.title,
          .caption = "Processor time against error, one curve for each series of settings. " +
                     study.conclusion + (outside > 0 ? note : ""),
          .alt =
              "Processor time against error on logarithmic axes, one curve for each series of "
              "settings, with the Pareto front below them. " +
              study.conclusion,
          .height = 350 + key_height,
          .commands = script.commands(),
          .data = table_of(study),
          .is_linked = true};
}

}  // namespace trammel::reports
