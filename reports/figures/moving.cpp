#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/figures/outline.h"

namespace trammel::reports {

namespace {

using Json = nlohmann::json;
using Coordinates = std::vector<long>;

/// Lines of a drawing, with nodes numbered in the order in which they are drawn.
class Panel {
 public:
  Panel(const Drawing& drawing, const Box& box, double width)
      : box_(box), scale_(10 * width / box.width()) {
    json["panel"] = {std::lround(10 * width), std::lround(scale_ * box.height())};
    json["lines"] = renumbered(polylines(drawing));
    const auto edges = triangle_edges(drawing);
    const bool loops = !edges.empty() && edges.front().front() == edges.front().back();
    json["edges"] = renumbered(edges);
    json["fill"] = renumbered(loops ? edges : drawing.triangles);
  }

  /// Returns x and y of each drawn node. @param of  vectors of all nodes of the drawing
  [[nodiscard]] Coordinates vectors(const std::vector<Point>& of, double factor = 1) const {
    Coordinates numbers(2 * places_.size());
    for (const auto& [node, place] : places_) {
      const auto& [x, y] = of[static_cast<std::size_t>(node)];
      numbers[2 * static_cast<std::size_t>(place)] = std::lround(scale_ * factor * x);
      numbers[2 * static_cast<std::size_t>(place) + 1] = std::lround(-scale_ * factor * y);
    }
    return numbers;
  }

  [[nodiscard]] Coordinates places(std::vector<Point> nodes) const {
    for (auto& [x, y] : nodes) x -= box_.x.low, y -= box_.y.high;
    return vectors(nodes);
  }

  Json json;

 private:
  Json renumbered(std::vector<std::vector<int>> lines) {
    for (auto& line : lines)
      for (int& node : line)
        node = places_.emplace(node, static_cast<int>(places_.size())).first->second;
    return lines;
  }

  Box box_;
  double scale_;
  std::map<int, int> places_;
};

/// Returns the differences of each row from the row before.
Json steps(std::vector<Coordinates> rows) {
  for (std::size_t k = rows.size(); k-- > 1;)
    std::ranges::transform(rows[k], rows[k - 1], rows[k].begin(), std::minus());
  return rows;
}

}  // namespace

bool are_finite(const std::vector<Point>& points) {
  return std::ranges::all_of(
      points, [](const Point& p) { return std::isfinite(p.first) && std::isfinite(p.second); });
}

std::string moving_modes(const Drawing& drawing, const std::vector<double>& factor, const Box& box,
                         double panel) {
  Panel moving(drawing, box, panel);
  moving.json["nodes"] = moving.places(drawing.nodes);
  for (std::size_t s = 0; s < factor.size(); ++s) {
    const Shape& shape = drawing.shapes[s];
    moving.json["shapes"].push_back(
        {{"label", shape.label}, {"moved", moving.vectors(shape.displacement, factor[s])}});
  }
  return moving.json.dump();
}

std::string moving_poses(const Drawing& drawing, const std::vector<Pose>& moments, double factor,
                         const Box& box, double panel) {
  Panel moving(drawing, box, panel);
  std::vector<Coordinates> still, moved;
  for (const Pose& moment : moments) {
    moving.json["times"].push_back(*moment.time_s);
    still.push_back(moving.places(moment.nodes));
    const bool deflects = !moment.displacement.empty();
    moved.push_back(deflects ? moving.places(displaced(moment.nodes,
                                                       {moment.label, moment.displacement}, factor))
                             : still.back());
  }
  if (still != moved) moving.json["still"] = steps(std::move(still));
  moving.json["moved"] = steps(std::move(moved));
  return moving.json.dump();
}

}  // namespace trammel::reports
