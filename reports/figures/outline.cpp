#include "reports/figures/outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kCoarseMesh = 12;  ///< with more triangles, not all edges are drawn
constexpr std::size_t kFineMesh = 600;   ///< with more triangles, no inner edges are drawn

/// Returns true if the line from `from` through `p` to `to` changes direction by less than 1e-3 rad
/// at `p`.
bool is_straight(const std::vector<double>& from, const Point& p, const Point& to) {
  const double ax = p.first - from[0], ay = p.second - from[1];
  const double bx = to.first - p.first, by = to.second - p.second;
  const double lengths = std::hypot(ax, ay) * std::hypot(bx, by);
  return std::abs(ax * by - ay * bx) <= 1e-3 * lengths && ax * bx + ay * by >= 0;
}

/// Returns whether the corners of a triangle are in counterclockwise order.
bool is_counterclockwise(const std::vector<int>& triangle, const std::vector<Point>& nodes) {
  const std::size_t step = triangle.size() / 3;
  const Point &a = nodes[triangle[0]], &b = nodes[triangle[step]], &c = nodes[triangle[2 * step]];
  return (b.first - a.first) * (c.second - a.second) > (c.first - a.first) * (b.second - a.second);
}

/// A side of a triangle in counterclockwise order, with its middle node if there is one, and the
/// number of triangles that contain the side.
struct Side {
  std::vector<int> nodes;
  int uses = 0;
};

std::map<std::pair<int, int>, Side> sides(const Drawing& drawing) {
  std::map<std::pair<int, int>, Side> found;
  for (const auto& t : drawing.triangles) {
    const std::size_t step = t.size() / 3;
    const bool left = is_counterclockwise(t, drawing.nodes);
    for (std::size_t i = 0; i < t.size(); i += step) {
      const int from = t[i], to = t[(i + step) % t.size()];
      Side& side = found[std::minmax(from, to)];
      side.nodes.assign(t.begin() + static_cast<long>(i), t.begin() + static_cast<long>(i + step));
      side.nodes.push_back(to);
      if (!left) std::ranges::reverse(side.nodes);
      ++side.uses;
    }
  }
  return found;
}

/// Returns the sides that belong to only one triangle, joined to closed loops of node numbers.
/// Loops are counterclockwise around a mesh, and clockwise around its holes.
std::vector<std::vector<int>> outline(const Drawing& drawing) {
  std::multimap<int, std::vector<int>> from;
  for (auto& [_, side] : sides(drawing))
    if (side.uses == 1) from.emplace(side.nodes.front(), std::move(side.nodes));
  std::vector<std::vector<int>> loops;
  while (!from.empty()) {
    std::vector<int> loop = {from.begin()->first};
    for (auto next = from.begin(); next != from.end(); next = from.find(loop.back())) {
      loop.insert(loop.end(), next->second.begin() + 1, next->second.end());
      from.erase(next);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

double tick_spacing(double min_step) {
  const double power = std::pow(10.0, std::floor(std::log10(min_step)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= min_step) return digit * power;
  return 10 * power;
}

std::string titled(const std::string& what, const CaseInfo& info, const Run& run) {
  return run.variant == "base" ? what : what + ": " + info.variant_title(run.variant);
}

std::vector<std::vector<int>> polylines(const Drawing& drawing) {
  std::vector<std::vector<int>> lines;
  for (const auto& member : drawing.members) {
    if (!lines.empty() && lines.back().back() == member[0])
      lines.back().push_back(member[1]);
    else
      lines.push_back(member);
  }
  return lines;
}

std::vector<std::vector<int>> triangle_edges(const Drawing& drawing) {
  if (drawing.triangles.size() > kCoarseMesh) return outline(drawing);
  std::vector<std::vector<int>> lines;
  for (auto& [_, side] : sides(drawing)) lines.push_back(std::move(side.nodes));
  return lines;
}

std::vector<std::vector<int>> triangle_edges_inside(const Drawing& drawing, std::size_t panels) {
  std::vector<std::vector<int>> lines;
  const std::size_t triangles = drawing.triangles.size();
  if (triangles <= kCoarseMesh || panels * triangles > kFineMesh) return lines;
  for (auto& [_, side] : sides(drawing))
    if (side.uses > 1) lines.push_back(std::move(side.nodes));
  return lines;
}

PlotScript::Rows polyline_points(const std::vector<std::vector<int>>& lines,
                                 const std::vector<Point>& nodes) {
  PlotScript::Rows rows;
  for (const auto& line : lines) {
    if (!rows.empty()) rows.emplace_back();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point& p = nodes[line[i]];
      const bool inner = i > 0 && i + 1 < line.size();
      if (inner && is_straight(rows.back(), p, nodes[line[i + 1]])) continue;
      rows.push_back({p.first, p.second});
    }
  }
  return rows;
}

std::vector<std::vector<int>> filled_loops(const Drawing& drawing) {
  if (drawing.triangles.size() > kCoarseMesh) return outline(drawing);
  std::vector<std::vector<int>> loops = drawing.triangles;
  for (auto& loop : loops) loop.push_back(loop.front());
  return loops;
}

PlotScript::Rows filled_triangles(const Drawing& drawing, const std::vector<Point>& nodes) {
  const std::vector<std::vector<int>> loops = filled_loops(drawing);
  if (drawing.triangles.size() <= kCoarseMesh) return polyline_points(loops, nodes);
  // One polygon passes through all loops, and returns to its first point after each loop. Gnuplot
  // then does not fill the holes.
  std::vector<std::vector<int>> closed;
  for (const auto& loop : loops) {
    if (closed.empty()) {
      closed.push_back(loop);
    } else {
      closed.front().insert(closed.front().end(), loop.begin(), loop.end());
      closed.front().push_back(closed.front().front());
    }
  }
  return polyline_points(closed, nodes);
}

std::vector<Point> moved_nodes(const std::vector<Point>& nodes, const Shape& shape, double factor) {
  std::vector<Point> out = nodes;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].first += factor * shape.displacement[i].first;
    out[i].second += factor * shape.displacement[i].second;
  }
  return out;
}

Box box_around(const std::vector<std::vector<Point>>& sets, double margin, double min_aspect) {
  Box box;
  for (const auto& set : sets)
    for (const auto& [x, y] : set) box.x.cover(x), box.y.cover(y);
  const double side = std::max(box.side(), 1e-12);
  for (Interval* range : {&box.x, &box.y})
    range->widen(margin * side + std::max(0.0, 0.5 * (min_aspect * side - range->length())));
  return box;
}

void set_axis_ranges(PlotScript& script, const Box& box) {
  script.range("x", box.x.low, box.x.high);
  script.range("y", box.y.low, box.y.high);
  script.command("set size ratio -1");
  script.axis_label("x", "x (m)");
  script.axis_label("y", "y (m)");
  const std::string step = shortest_decimal(tick_spacing(box.side() / 5));
  script.command("set xtics " + step + "; set ytics " + step);
}

void draw_body(PlotScript& script, const Drawing& drawing, const std::vector<Point>& nodes,
               const std::string& color, double width, const std::string& title) {
  const std::string line = "with lines" + lc(color) + " lw ";
  script.curve(polyline_points(triangle_edges(drawing), nodes),
               line + shortest_decimal(0.5 * width), drawing.members.empty() ? title : "");
  script.curve(polyline_points(polylines(drawing), nodes), line + shortest_decimal(width), title);
}

int drawing_height(const Box& box) {
  return static_cast<int>(std::clamp(410.0 * box.height() / box.width(), 90.0, 470.0)) + 80;
}

}  // namespace trammel::reports
