#include <algorithm>
#include <cmath>
#include <map>

#include "reports/figures/figures.h"
#include "reports/number.h"
#include "reports/palette.h"
#include "reports/plot_script.h"

namespace trammel::reports {

namespace {

constexpr std::size_t most_curves = 7;  ///< that can be told apart

/// One sweep of one run: (relative error of the worst entry, processor time [s]), coarse to fine.
struct Curve {
  std::string title, case_id, variant, sweep;
  std::vector<double> parameter;
  PlotScript::Rows points;
};

/// The worst error over all entries of the sweep's first quantity at each level.
std::map<double, double> worst_errors(const Run& run, const std::string& sweep) {
  std::map<double, double> worst;
  std::string quantity;
  for (const Convergence& c : run.convergence) {
    if (c.sweep != sweep || (!quantity.empty() && c.quantity != quantity)) continue;
    quantity = c.quantity;
    for (std::size_t k = 0; k < c.parameter.size(); ++k)
      if (c.error[k] && *c.error[k] != 0)
        worst[c.parameter[k]] = std::max(worst[c.parameter[k]], std::abs(*c.error[k]));
  }
  return worst;
}

std::vector<Curve> curves_of(const std::map<std::string, std::string>& titles,
                             const std::vector<const Run*>& runs) {
  std::vector<Curve> curves;
  for (const Run* run : runs) {
    if (run->variant != "base") continue;
    for (const SweepCost& cost : run->cost.sweeps) {
      Curve curve{titles.at(run->case_id), run->case_id, run->variant, cost.sweep, {}, {}};
      const std::map<double, double> errors = worst_errors(*run, cost.sweep);
      for (std::size_t k = 0; k < cost.parameter.size(); ++k) {
        const auto error = errors.find(cost.parameter[k]);
        if (error == errors.end() || !cost.cpu_s[k] || *cost.cpu_s[k] <= 0) continue;
        curve.parameter.push_back(cost.parameter[k]);
        curve.points.push_back({error->second, *cost.cpu_s[k]});
      }
      if (curve.points.size() > 2) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

/// The first time at which a curve is below an error; negative if it never is.
double time_to(const Curve& curve, double error) {
  for (const auto& point : curve.points)
    if (point[0] <= error) return point[1];
  return -1;
}

/// "An error below 10⁻⁶ in every mode takes 0.2 ms (Cantilever) to 3 ms (Free-free beam) ..."
std::string conclusion(const std::vector<Curve>& curves) {
  for (const double error : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const Curve* quick = nullptr;
    const Curve* slow = nullptr;
    bool all = true;
    for (const Curve& curve : curves) {
      const double time = time_to(curve, error);
      all = all && time >= 0;
      if (!quick || time < time_to(*quick, error)) quick = &curve;
      if (!slow || time > time_to(*slow, error)) slow = &curve;
    }
    if (!all || !quick) continue;
    std::string text = "A relative error below " + relative(error, 1, false) +
                       " in every entry takes " + duration(time_to(*quick, error));
    if (curves.size() > 1)
      text += " (" + quick->title + ") to " + duration(time_to(*slow, error)) + " (" + slow->title +
              ")";
    return text + ". Each level was timed once.";
  }
  return "Each level was timed once.";
}

Table table_of(const std::vector<Curve>& curves) {
  Table table;
  table.heads = {"case", "variant", "sweep", "parameter", "worst_relative_error", "cpu_s"};
  for (const Curve& curve : curves)
    for (std::size_t k = 0; k < curve.points.size(); ++k)
      table.rows.push_back({curve.case_id, curve.variant, curve.sweep, curve.parameter[k],
                            curve.points[k][0], curve.points[k][1]});
  return table;
}

}  // namespace

std::optional<Figure> accuracy_figure(const std::string& family,
                                      const std::map<std::string, std::string>& titles,
                                      const std::vector<const Run*>& runs) {
  std::vector<Curve> curves = curves_of(titles, runs);
  if (curves.empty()) return std::nullopt;
  Figure figure;
  figure.data = table_of(curves);
  figure.caption = conclusion(curves);
  if (curves.size() > most_curves) curves.resize(most_curves);

  PlotScript script;
  double low_error = 1, high_error = 1e-16, low_time = 1e9, high_time = 1e-9;
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const auto& point : curves[i].points) {
      low_error = std::min(low_error, point[0]);
      high_error = std::max(high_error, point[0]);
      low_time = std::min(low_time, point[1]);
      high_time = std::max(high_time, point[1]);
    }
    const std::string mark =
        std::to_string(palette::filled_point[i % palette::filled_point.size()]);
    script.curve(curves[i].points,
                 "with linespoints lw 1.4 ps 0.7 pt " + mark + lc(palette::color(i)),
                 curves[i].title);
    keys.push_back(curves[i].title);
  }
  script.log_axis("x", low_error, high_error);
  script.log_axis("y", low_time, high_time);
  script.axis_label("x", "relative error of the worst entry");
  script.axis_label("y", "processor time (s)");
  figure.height = 330 + script.key_below(keys);
  script.plot();

  figure.id = slug(family + "-accuracy");
  figure.title = "What accuracy costs in time";
  figure.alt =
      "Processor time against error on logarithmic axes, a curve a case. " + figure.caption;
  figure.commands = script.commands();
  return figure;
}

}  // namespace trammel::reports
