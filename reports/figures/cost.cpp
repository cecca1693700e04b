#include "reports/figures/cost.h"

#include <algorithm>
#include <cmath>

#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr double kSmallestDrawnCostError = 1e-16;  ///< stands for an error of zero

struct CostExtent {
  double low_error = 1e300, high_error = 0, low_time = 1e300, high_time = 0;
};

double drawn_error(const CostStudy& study, const CostSetting& setting) {
  return std::max(study.error(setting).value_or(0), kSmallestDrawnCostError);
}

bool is_drawn(const CostStudy& study, const CostSetting& setting) {
  return setting.measured() && study.error(setting) && setting.relative;
}

CostExtent extent_of(const CostStudy& study) {
  CostExtent extent;
  const auto cover_time = [&](double time) {
    if (!(time > 0)) return;
    extent.low_time = std::min(extent.low_time, time);
    extent.high_time = std::max(extent.high_time, time);
  };
  for (const CostSetting& setting : study.settings) {
    cover_time(setting.relative.value_or(0));
    if (!is_drawn(study, setting)) continue;
    extent.low_error = std::min(extent.low_error, drawn_error(study, setting));
    extent.high_error = std::max(extent.high_error, drawn_error(study, setting));
  }
  if (extent.high_error == 0) extent.low_error = extent.high_error = 1;
  // No point stands on the frame.
  extent.low_error /= 1.3, extent.high_error *= 1.3;
  extent.low_time /= 1.3, extent.high_time *= 1.3;
  return extent;
}

std::vector<std::string> curves_of(const CostStudy& study) {
  std::vector<std::string> curves;
  for (const CostSetting& setting : study.settings)
    if (std::ranges::find(curves, setting.curve) == curves.end()) curves.push_back(setting.curve);
  return curves;
}

std::string point_type(std::size_t curve, bool filled) {
  const auto& types = filled ? palette::kFilledPoint : palette::kOpenPoint;
  return std::to_string(types[curve % types.size()]);
}

/// Where what has no usable error stands: right of the axis, in a strip of its own.
struct Strip {
  double left = 0, middle = 0, right = 0;
};

Strip strip_of(double low, double high) {
  const double width = std::max(0.35, 0.12 * std::log10(high / low));
  return {high, high * std::pow(10, width / 2), high * std::pow(10, width)};
}

void draw_strip(PlotScript& script, const Strip& strip) {
  script.command("set object 1 rectangle from " + shortest(strip.left) + ", graph 0 to " +
                 shortest(strip.right) + ", graph 1 behind fillstyle solid noborder fc rgb '" +
                 palette::kBlush + "'");
  script.label("no answer", shortest(strip.middle) +
                                ", graph 0.5 center rotate front textcolor rgb '" +
                                palette::kMuted + "'");
}

/// The steps of the front: within an error, its cheapest setting.
PlotScript::Rows steps_of(const CostStudy& study, const CostExtent& extent) {
  std::vector<std::pair<double, double>> front;
  for (const CostSetting& setting : study.settings)
    if (setting.pareto_optimal && is_drawn(study, setting))
      front.emplace_back(drawn_error(study, setting), *setting.relative);
  std::sort(front.rbegin(), front.rend());
  PlotScript::Rows rows;
  for (const auto& [error, time] : front) {
    if (rows.empty()) {
      rows.push_back({extent.high_error, time});
    } else {
      rows.push_back({rows.back()[0], time});
    }
    rows.push_back({error, time});
  }
  return rows;
}

void draw_curve(PlotScript& script, const CostStudy& study, const std::string& curve,
                std::size_t number, const Strip& strip) {
  PlotScript::Rows points, outside;
  std::string title;
  for (const CostSetting& setting : study.settings) {
    if (setting.curve != curve) continue;
    title = setting.curve_title;
    if (setting.without_result() && setting.relative && *setting.relative > 0)
      outside.push_back({strip.middle, *setting.relative});
    if (!is_drawn(study, setting)) continue;
    const double time = *setting.relative;
    points.push_back({drawn_error(study, setting), time,
                      setting.time ? setting.time->relative_low : time,
                      setting.time ? setting.time->relative_high : time});
  }
  const std::string color = lc(palette::color(number));
  const bool filled = number < palette::kFilledPoint.size();
  const std::string mark = point_type(number, filled);
  script.curve(points, "using 1:2 with lines lw 1.2" + color);
  script.curve(points, "using 1:2:3:4 with yerrorbars lw 1.2 ps 0.8 pt " + mark + color);
  script.curve(outside, "using 1:2 with points lw 1.6 ps 1 pt 2" + color);
  script.key_entry("with linespoints lw 1.2 ps 0.8 pt " + mark + color, title);
}

Table table_of(const CostStudy& study) {
  Table table;
  table.heads = {"setting",
                 "curve",
                 "value",
                 "status",
                 "reason",
                 "error_max",
                 "error_rms",
                 "error_mean",
                 "cpu_s",
                 "relative_time",
                 "relative_time_low",
                 "relative_time_high",
                 "pareto_optimal"};
  for (const auto& counter : study.settings.front().counters) table.heads.push_back(counter.first);
  for (const CostSetting& s : study.settings) {
    const ErrorNorms errors = s.errors.value_or(ErrorNorms{});
    std::vector<Table::Cell> row = {s.title,
                                    s.curve,
                                    cell(s.value),
                                    s.status,
                                    s.reason,
                                    cell(errors.max),
                                    cell(errors.rms),
                                    cell(errors.mean),
                                    s.cpu_s,
                                    cell(s.relative),
                                    cell(s.time ? Number(s.time->relative_low) : Number()),
                                    cell(s.time ? Number(s.time->relative_high) : Number()),
                                    std::string(s.pareto_optimal ? "yes" : "no")};
    for (const auto& counter : s.counters) row.emplace_back(static_cast<double>(counter.second));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string notes_on(const CostStudy& study) {
  std::size_t outside = 0;
  for (const CostSetting& setting : study.settings) {
    outside += setting.without_result() ? 1 : 0;
  }
  std::string text;
  if (outside > 0)
    text += " The strip at the edge holds " + count(outside, "setting") + " without an answer.";
  return text;
}

}  // namespace

Figure cost_figure(const CostStudy& study) {
  PlotScript script;
  const CostExtent extent = extent_of(study);
  const bool any_outside =
      std::ranges::any_of(study.settings, [](const CostSetting& s) { return s.without_result(); });
  script.log_axis("x", extent.low_error, extent.high_error);
  script.log_axis("y", extent.low_time, extent.high_time);
  const double low = std::pow(10, std::floor(std::log10(extent.low_error) + 1e-9));
  const double high = std::pow(10, std::ceil(std::log10(extent.high_error) - 1e-9));
  const Strip strip = strip_of(low, high);
  if (any_outside) {
    script.range("x", low, strip.right);
    draw_strip(script, strip);
  }
  script.axis_label("x", "relative error (" + study.norm + ")");
  script.axis_label("y", "time, relative to the baseline");
  CostExtent whole = extent;
  whole.high_error = high;
  script.curve(steps_of(study, whole),
               std::string("using 1:2 with lines lw 5") + lc(palette::kPlate), "efficient front");
  const std::vector<std::string> curves = curves_of(study);
  std::vector<std::string> keys = {"efficient front"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    draw_curve(script, study, curves[i], i, strip);
    const auto first = std::ranges::find_if(
        study.settings, [&](const CostSetting& s) { return s.curve == curves[i]; });
    keys.push_back(first->curve_title);
  }
  Figure figure;
  figure.height = 350 + script.key_below(keys);
  script.plot();
  figure.id = slug("cost-" + study.id);
  figure.title = study.title;
  figure.caption = study.conclusion + notes_on(study);
  figure.alt =
      "Time against error on logarithmic axes, a curve for each kind of setting, with the "
      "efficient front below them. " +
      study.conclusion;
  figure.commands = script.commands();
  figure.data = table_of(study);
  return figure;
}

}  // namespace trammel::reports
