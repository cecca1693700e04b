#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxDrawnInstants = 6;

/// Largest deflection of all nodes and instants, and the time at which it occurs.
struct Largest {
  double length = 0, time = 0;
};

Largest largest_deflection(const std::vector<Pose>& instants) {
  Largest found;
  for (const Pose& instant : instants)
    for (const auto& [x, y] : instant.displacement)
      if (std::hypot(x, y) > found.length) found = {std::hypot(x, y), *instant.time_s};
  return found;
}

std::vector<Pose> instants_of_drawing(const Drawing& drawing) {
  std::vector<Pose> instants;
  for (const Pose& pose : drawing.poses) {
    const bool finite = are_finite_points(pose.nodes) && are_finite_points(pose.displacement);
    if (pose.time_s && finite && (instants.empty() || *pose.time_s > *instants.back().time_s))
      instants.push_back(pose);
  }
  return instants;
}

/// Returns the factor by which the drawing magnifies deflections, with two significant digits and
/// at least 1.
double magnification(double deflection, double side) {
  if (!(deflection > 0)) return 1;
  const double factor = kDrawnAmplitude * side / deflection;
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 1);
  return std::max(1.0, std::floor(factor / unit) * unit);
}

std::string caption_text(const std::vector<Pose>& instants, const Largest& deflection,
                         double factor, const std::string& drawn) {
  const std::string all = " Instants: " + drawn + ". Animated: " + std::to_string(instants.size()) +
                          " instants up to " + trimmed(*instants.back().time_s, 4) +
                          "\u202fs, interpolated linearly.";
  if (deflection.length > 0)
    return "Deflected mechanism (blue) and rigid links (gray); deflections are " +
           (factor > 1 ? "magnified " + trimmed(factor, 2) + " times." : std::string("to scale.")) +
           all + " The largest deflection is " + length_text(deflection.length) + ", at " +
           trimmed(deflection.time, 3) + "\u202fs.";
  return "Positions to scale." + all;
}

Table table_of(const std::vector<Pose>& instants) {
  Table table{words_in("time_s node x_m y_m u_x_m u_y_m"), {}, kSampleDigits};
  for (const Pose& instant : instants)
    for (std::size_t i = 0; i < instant.nodes.size(); ++i) {
      const Point u = instant.displacement.empty() ? Point() : instant.displacement[i];
      table.rows.push_back({*instant.time_s, static_cast<double>(i), instant.nodes[i].first,
                            instant.nodes[i].second, u.first, u.second});
    }
  return table;
}

using Json = nlohmann::json;
using Coordinates = std::vector<long>;

/// Lines of a drawing as JSON for the animation by page.js. Nodes are numbered in the order in
/// which they are drawn; nodes that are not drawn have no number. Coordinates are in units of 0.1
/// px, with y downwards.
class Panel {
 public:
  Panel(const Drawing& drawing, const Box& box, double width)
      : box_(box), scale_(10 * width / box.width()) {
    json["panel"] = {std::lround(10 * width), std::lround(scale_ * box.height())};
    json["lines"] = renumbered(polylines(drawing));
    json["edges"] = renumbered(triangle_edges(drawing));
    json["fill"] = renumbered(filled_loops(drawing));
  }

  /// Returns the coordinates of each drawn node. @param nodes  positions of all nodes
  [[nodiscard]] Coordinates places(const std::vector<Point>& nodes) const {
    Coordinates numbers(2 * places_.size());
    for (const auto& [node, place] : places_) {
      const auto& [x, y] = nodes[static_cast<std::size_t>(node)];
      numbers[2 * static_cast<std::size_t>(place)] = std::lround(scale_ * (x - box_.x.low));
      numbers[2 * static_cast<std::size_t>(place) + 1] = std::lround(scale_ * (box_.y.high - y));
    }
    return numbers;
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

/// Replaces each row of coordinates by its difference from the previous row.
Json row_differences(std::vector<Coordinates> rows) {
  for (std::size_t k = rows.size(); k-- > 1;)
    std::ranges::transform(rows[k], rows[k - 1], rows[k].begin(), std::minus());
  return rows;
}

/// Returns the animation of a motion as JSON: the node positions at each instant with magnified
/// deflections. If any node deflects, it also contains the positions without deflections. Positions
/// are stored as differences from the previous instant.
std::string animation_json(const Drawing& drawing, const std::vector<Pose>& instants, double factor,
                           const Box& box, double panel) {
  Panel moving(drawing, box, panel);
  std::vector<Coordinates> still, moved;
  for (const Pose& instant : instants) {
    moving.json["times"].push_back(*instant.time_s);
    still.push_back(moving.places(instant.nodes));
    const bool deflects = !instant.displacement.empty();
    moved.push_back(deflects ? moving.places(moved_nodes(
                                   instant.nodes, {instant.label, instant.displacement}, factor))
                             : still.back());
  }
  if (still != moved) moving.json["still"] = row_differences(std::move(still));
  moving.json["moved"] = row_differences(std::move(moved));
  return moving.json.dump();
}

}  // namespace

std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run) {
  if (!run.drawing || (run.drawing->members.empty() && run.drawing->triangles.empty()))
    return std::nullopt;
  const Drawing& drawing = *run.drawing;
  const std::vector<Pose> instants = instants_of_drawing(drawing);
  if (instants.size() < 2) return std::nullopt;
  const Largest deflection = largest_deflection(instants);
  const double factor = magnification(deflection.length, box_around({drawing.nodes}, 0, 0).side());
  std::vector<std::vector<Point>> places, everything;
  for (const Pose& instant : instants) {
    places.push_back(instant.nodes);
    if (!instant.displacement.empty())
      places.back() = moved_nodes(instant.nodes, {instant.label, instant.displacement}, factor);
    everything.insert(everything.end(), {instant.nodes, places.back()});
  }
  const Box box = box_around(everything, 0.04, 0.22);
  PlotScript script;
  set_axis_ranges(script, box);
  const std::size_t stride = (instants.size() + kMaxDrawnInstants - 2) / (kMaxDrawnInstants - 1);
  std::string drawn;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const bool last = k + 1 == instants.size();
    if (k % stride != 0 && !last) continue;
    drawn += (k == 0 ? "" : ", ") + trimmed(*instants[k].time_s, 3);
    draw_body(script, drawing, instants[k].nodes, palette::kStructure, 1);
    draw_body(script, drawing, places[k], palette::color(0), k == 0 ? 2.4 : 1.1);
  }
  script.plot();
  const auto caption = caption_text(instants, deflection, factor, drawn + "\u202fs (thick: first)");
  return Figure{.id = slug(info.id + "-" + run.variant + "-motion"),
                .title = titled("Motion", info, run),
                .caption = caption,
                .alt = "Outlines of the mechanism at a few instants. " + caption,
                .height = drawing_height(box),
                .commands = script.commands(),
                .data = table_of(instants),
                .moving = animation_json(drawing, instants, factor, box, 500)};
}

bool are_finite_points(const std::vector<Point>& points) {
  return std::ranges::all_of(
      points, [](const Point& p) { return std::isfinite(p.first) && std::isfinite(p.second); });
}

}  // namespace trammel::reports
