#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxShapes = 8;

double factor_for(const Shape& shape, double side) {
  double largest = 0;
  for (const auto& [ux, uy] : shape.displacement) largest = std::max(largest, std::hypot(ux, uy));
  return largest > 0 && std::isfinite(largest) ? kDrawnAmplitude * side / largest : 0;
}

void draw_panel(PlotScript& script, const Drawing& drawing, const std::vector<Point>& moved,
                const std::string& label, std::size_t panels) {
  script.command("unset label");
  script.label(
      label, "graph 0.5,1 center offset 0,0.75 textcolor rgb '" + std::string(palette::kInk) + "'");
  draw_body(script, drawing, drawing.nodes, palette::kStructure, 1.2);
  script.curve(filled_triangles(drawing, moved), "with filledcurves closed" + lc(palette::kPlate));
  script.curve(polyline_points(triangle_edges_inside(drawing, panels), moved),
               "with lines lw 0.4" + lc(palette::color(0)));
  draw_body(script, drawing, moved, palette::color(0), 2.2);
  script.plot();
}

/// Returns whether a shape is a vibration mode, labeled as "mode 3, 15.1 Hz".
bool is_mode(const Shape& shape) {
  return shape.label.starts_with("mode") && shape.label.find(" Hz") != std::string::npos;
}

/// Returns whether the shapes can be animated: vibration modes with finite displacements.
bool can_move(const Drawing& drawing, std::size_t shapes) {
  bool finite = are_finite(drawing.nodes);
  for (std::size_t s = 0; s < shapes; ++s)
    finite = finite && is_mode(drawing.shapes[s]) && are_finite(drawing.shapes[s].displacement);
  return finite;
}

/// Returns "1 mode is a rigid-body mode. Modes 2 to 6 have 15.1 Hz to 98.3 Hz."
std::string modes_text(const Drawing& drawing, std::size_t n, const Run& run) {
  if (!is_mode(drawing.shapes.front())) {
    const std::string label = drawing.shapes.front().label;
    return "The lowest mode buckles at " + label.substr(label.find(", ") + 2) + ".";
  }
  const auto* frequency = run.quantity("frequency_Hz");
  std::vector<double> values;
  for (std::size_t s = 0; frequency && s < std::min(n, frequency->size()); ++s)
    values.push_back(Number((*frequency)[s]).value_or(0));
  if (values.size() < n) return "";
  std::size_t free = 0;
  while (free < n && values[free] <= 1e-4 * values.back()) ++free;
  const auto hertz = [](double value) { return trimmed(value, 4) + "\u202fHz"; };
  std::string text;
  if (free > 0) text = count(free, "mode is a rigid-body mode", "modes are rigid-body modes") + ".";
  if (free == n) return text;
  if (free + 1 == n)
    return text + " Mode " + std::to_string(n) + " has " + hertz(values.back()) + ".";
  return text + " Modes " + std::to_string(free + 1) + " to " + std::to_string(n) + " have " +
         hertz(values[free]) + " to " + hertz(values.back()) + ".";
}

/// Returns "The largest displacement is 1.2 mm, magnified 83 times."
std::string displacements_text(const Drawing& drawing, const std::vector<double>& factors,
                               double side) {
  std::size_t largest = 0;
  for (std::size_t s = 1; s < factors.size(); ++s)  // the shape with the smallest magnification
    if (factors[s] > 0 && !(factors[largest] > 0 && factors[largest] <= factors[s])) largest = s;
  if (!(factors[largest] > 0)) return "Nothing is displaced.";
  const std::string of = factors.size() > 1 ? " (" + drawing.shapes[largest].label + ")" : "";
  return "The largest displacement is " + length_text(kDrawnAmplitude * side / factors[largest]) +
         of + ", magnified " + trimmed(factors[largest], 2) + " times.";
}

}  // namespace

std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run) {
  if (!run.drawing || run.drawing->shapes.empty()) return std::nullopt;
  const Drawing& drawing = *run.drawing;
  if (drawing.members.empty() && drawing.triangles.empty()) return std::nullopt;
  const double side = box_around({drawing.nodes}, 0, 0).side();
  const std::size_t n = std::min(drawing.shapes.size(), kMaxShapes);
  std::vector<std::vector<Point>> moved;
  std::vector<double> factors;
  Table table{words_in("node x_m y_m"), {}, kSampleDigits};
  for (std::size_t i = 0; i < drawing.nodes.size(); ++i)
    table.rows.push_back({static_cast<double>(i), drawing.nodes[i].first, drawing.nodes[i].second});
  for (std::size_t s = 0; s < n; ++s) {
    const Shape& shape = drawing.shapes[s];
    const double factor = factor_for(shape, side);
    factors.push_back(factor);
    moved.push_back(displaced(drawing.nodes, shape, factor));
    for (const char* head : {"u_x_m [", "u_y_m ["})
      table.heads.push_back(head + shape.label + "; drawn " + shortest_decimal(factor, 4) +
                            " times]");
    for (std::size_t i = 0; i < drawing.nodes.size(); ++i)
      table.rows[i].insert(table.rows[i].end(),
                           {shape.displacement[i].first, shape.displacement[i].second});
  }
  auto everything = moved;
  everything.push_back(drawing.nodes);
  const Box box = box_around(everything, 0.02, 0.22);
  const std::size_t columns = n == 1 ? 1 : n <= 4 ? 2 : 3, rows = (n + columns - 1) / columns;
  const double panel = 500.0 / static_cast<double>(columns);
  const double height = std::clamp(panel * box.height() / box.width(), 55.0, 270.0) + 32;

  PlotScript script;
  script.command("set lmargin 0; set rmargin 0; set tmargin 2; set bmargin 0");
  set_axis_ranges(script, box);
  script.command("unset border; unset tics; unset xlabel; unset ylabel; unset grid; unset key");
  script.command("set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns));
  for (std::size_t s = 0; s < n; ++s)
    draw_panel(script, drawing, moved[s], drawing.shapes[s].label, n);
  script.command("unset multiplot");

  const bool modes = drawing.shapes.front().label.starts_with("mode");
  std::string labels;
  for (std::size_t s = 0; s < n; ++s) add_item(labels, drawing.shapes[s].label, "; ");
  return Figure{
      .id = slug(info.id + "-" + run.variant + "-shapes"),
      .title = titled(modes ? "Mode shapes" : "Deformed shapes", info, run),
      .caption =
          "Undeformed (gray) and deformed (blue) shapes, each scaled so that its largest "
          "displacement is " +
          trimmed(100 * kDrawnAmplitude, 2) + "\u202f% of the longer side. " +
          (modes ? modes_text(drawing, n, run) : displacements_text(drawing, factors, side)),
      .alt = "Drawings of the shapes: " + labels,
      .height = static_cast<int>(height * static_cast<double>(rows)) + 8,
      .commands = script.commands(),
      .data = std::move(table),
      .moving = can_move(drawing, n) ? mode_animation(drawing, factors, box, panel) : ""};
}

}  // namespace trammel::reports
