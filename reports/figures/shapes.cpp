#include "reports/figures/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxShapes = 8;
constexpr double kDrawnAmplitude = 0.13;  ///< of the longer side

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
  const auto lines = polylines(drawing);
  const auto edges = triangle_edges(drawing);
  const std::string grey = lc(palette::kStructure);
  const std::string blue = lc(palette::color(0));
  script.curve(rows_of(edges, drawing.nodes), "with lines lw 1" + grey);
  script.curve(rows_of(lines, drawing.nodes), "with lines lw 1.2" + grey);
  script.curve(filled_triangles(drawing, moved), "with filledcurves closed" + lc(palette::kPlate));
  script.curve(rows_of(triangle_edges_inside(drawing, panels), moved), "with lines lw 0.4" + blue);
  script.curve(rows_of(edges, moved), "with lines lw 1.2" + blue);
  script.curve(rows_of(lines, moved), "with lines lw 2.2" + blue);
  script.plot();
}

/// Lines by the places of their nodes among those that are drawn.
Json renumbered(std::vector<std::vector<int>> lines, std::map<int, int>& places) {
  for (auto& line : lines)
    for (int& node : line)
      node = places.emplace(node, static_cast<int>(places.size())).first->second;
  return lines;
}

/// The modes for a page's script: a panel each, in tenths of a unit of the drawing, y downwards,
/// displacements as they are drawn.
/// @param factor  of each shape
std::string moving_modes(const Drawing& drawing, const std::vector<double>& factor, const Box& box,
                         double panel) {
  const double scale = 10 * panel / box.width();
  std::map<int, int> places;
  Json json;
  json["panel"] = {std::lround(10 * panel), std::lround(scale * box.height())};
  json["lines"] = renumbered(polylines(drawing), places);
  const auto edges = triangle_edges(drawing);
  const bool loops = !edges.empty() && edges.front().front() == edges.front().back();
  json["edges"] = renumbered(edges, places);
  json["fill"] = renumbered(loops ? edges : drawing.triangles, places);
  const auto points = [&](const auto& of) {
    std::vector<long> numbers(2 * places.size());
    for (const auto& [node, place] : places) {
      const auto [x, y] = of(static_cast<std::size_t>(node));
      numbers[2 * static_cast<std::size_t>(place)] = std::lround(scale * x);
      numbers[2 * static_cast<std::size_t>(place) + 1] = std::lround(-scale * y);
    }
    return numbers;
  };
  json["nodes"] = points([&](std::size_t i) {
    const auto& [x, y] = drawing.nodes[i];
    return Point(x - box.x0, y - box.y1);
  });
  for (std::size_t s = 0; s < factor.size(); ++s) {
    const Shape& shape = drawing.shapes[s];
    const auto moved = points([&](std::size_t i) {
      const auto& [ux, uy] = shape.displacement[i];
      return Point(factor[s] * ux, factor[s] * uy);
    });
    json["shapes"].push_back({{"label", shape.label}, {"moved", moved}});
  }
  return json.dump();
}

/// "mode 3, 15.1 Hz": what swings with a frequency.
bool is_mode(const Shape& shape) {
  return shape.label.rfind("mode", 0) == 0 && shape.label.find(" Hz") != std::string::npos;
}

bool is_drawn_whole(const Drawing& drawing, std::size_t shapes) {
  const auto finite = [](const Point& p) {
    return std::isfinite(p.first) && std::isfinite(p.second);
  };
  bool whole = std::all_of(drawing.nodes.begin(), drawing.nodes.end(), finite);
  for (std::size_t s = 0; s < shapes; ++s) {
    const auto& u = drawing.shapes[s].displacement;
    whole = whole && is_mode(drawing.shapes[s]) && std::all_of(u.begin(), u.end(), finite);
  }
  return whole;
}

}  // namespace

std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run) {
  if (!run.drawing || run.drawing->shapes.empty()) return std::nullopt;
  const Drawing& drawing = *run.drawing;
  if (drawing.members.empty() && drawing.triangles.empty()) return std::nullopt;
  const Box body = box_around({drawing.nodes}, 0, 0);
  const double side = std::max(body.width(), body.height());
  const std::size_t n = std::min(drawing.shapes.size(), kMaxShapes);
  std::vector<std::vector<Point>> moved;
  std::vector<double> factors;
  Figure figure;
  figure.data.heads = {"shape", "node", "x_m", "y_m", "u_x_m", "u_y_m", "drawn_times"};
  for (std::size_t s = 0; s < n; ++s) {
    const Shape& shape = drawing.shapes[s];
    const double factor = factor_for(shape, side);
    factors.push_back(factor);
    moved.push_back(displaced(drawing.nodes, shape, factor));
    for (std::size_t i = 0; i < drawing.nodes.size(); ++i)
      figure.data.rows.push_back({shape.label, static_cast<double>(i), drawing.nodes[i].first,
                                  drawing.nodes[i].second, shape.displacement[i].first,
                                  shape.displacement[i].second, factor});
  }
  auto everything = moved;
  everything.push_back(drawing.nodes);
  const Box box = box_around(everything, 0.02, 0.22);
  const std::size_t columns = n == 1 ? 1 : 2;
  const std::size_t rows = (n + columns - 1) / columns;
  const double panel = 500.0 / static_cast<double>(columns);
  const double height = std::clamp(panel * box.height() / box.width(), 55.0, 270.0) + 32;

  PlotScript script;
  script.command("set lmargin 0; set rmargin 0; set tmargin 2; set bmargin 0");
  frame(script, box);
  script.command("unset border; unset tics; unset grid; unset key");
  script.command("set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns));
  for (std::size_t s = 0; s < n; ++s)
    draw_panel(script, drawing, moved[s], drawing.shapes[s].label, n);
  script.command("unset multiplot");

  figure.id = slug(info.id + "-" + run.variant + "-shapes");
  const bool modes = drawing.shapes.front().label.rfind("mode", 0) == 0;
  figure.title = titled(modes ? "Mode shapes" : "Deformed shapes", info, run);
  figure.caption =
      "Grey: at rest; blue: displaced. Each shape is scaled so that its largest "
      "displacement is " +
      trimmed(100 * kDrawnAmplitude, 2) + "\u202f% of the longer side.";
  figure.alt = "Small pictures of the shapes";
  for (std::size_t s = 0; s < n; ++s) figure.alt += (s ? "; " : ": ") + drawing.shapes[s].label;
  figure.height = static_cast<int>(height * static_cast<double>(rows)) + 8;
  figure.commands = script.commands();
  if (is_drawn_whole(drawing, n)) figure.moving = moving_modes(drawing, factors, box, panel);
  return figure;
}

}  // namespace trammel::reports
