#include <algorithm>
#include <cmath>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxDrawnMoments = 6;

/// Largest length of the vectors of all moments, and its time.
struct Largest {
  double length = 0, time = 0;
};

/// @param of  returns the vectors of a moment
template <class Vectors>
Largest largest(const std::vector<Pose>& moments, const Vectors& of) {
  Largest found;
  for (const Pose& moment : moments)
    for (const auto& [x, y] : of(moment))
      if (std::hypot(x, y) > found.length) found = {std::hypot(x, y), *moment.time_s};
  return found;
}

std::vector<Pose> moments_of(const Drawing& drawing) {
  std::vector<Pose> moments;
  for (const Pose& pose : drawing.poses) {
    const bool whole = are_finite(pose.nodes) && are_finite(pose.displacement);
    if (pose.time_s && whole && (moments.empty() || *pose.time_s > *moments.back().time_s))
      moments.push_back(pose);
  }
  return moments;
}

/// Returns a factor with two digits, at least 1.
double magnification(double deflection, double side) {
  if (!(deflection > 0)) return 1;
  const double factor = kDrawnAmplitude * side / deflection;
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 1);
  return std::max(1.0, std::floor(factor / unit) * unit);
}

std::string caption_of(const std::vector<Pose>& moments, const Largest& deflection, double factor,
                       const std::string& drawn) {
  const std::string all = " Drawn: " + drawn + ". Animated: " + std::to_string(moments.size()) +
                          " moments up to " + trimmed(*moments.back().time_s, 4) +
                          "\u202fs, interpolated linearly.";
  if (deflection.length > 0)
    return "Deflected mechanism (blue) and rigid links (gray); deflections are drawn " +
           (factor > 1 ? trimmed(factor, 2) + " times magnified." : std::string("to scale.")) +
           all + " The largest deflection is " + length_text(deflection.length) + ", at " +
           trimmed(deflection.time, 3) + "\u202fs.";
  const std::vector<Point>& first = moments.front().nodes;
  const Largest way = largest(moments, [&](const Pose& moment) {
    std::vector<Point> moved = moment.nodes;
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i].first -= first[i].first, moved[i].second -= first[i].second;
    return moved;
  });
  return "Positions to scale." + all + " The largest distance of a point from its start is " +
         length_text(way.length) + ", at " + trimmed(way.time, 3) + "\u202fs.";
}

Table table_of(const std::vector<Pose>& moments) {
  Table table{words_in("time_s node x_m y_m u_x_m u_y_m"), {}, kSampleDigits};
  for (const Pose& moment : moments)
    for (std::size_t i = 0; i < moment.nodes.size(); ++i) {
      const Point u = moment.displacement.empty() ? Point() : moment.displacement[i];
      table.rows.push_back({*moment.time_s, static_cast<double>(i), moment.nodes[i].first,
                            moment.nodes[i].second, u.first, u.second});
    }
  return table;
}

}  // namespace

std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run) {
  if (!run.drawing || (run.drawing->members.empty() && run.drawing->triangles.empty()))
    return std::nullopt;
  const Drawing& drawing = *run.drawing;
  const std::vector<Pose> moments = moments_of(drawing);
  if (moments.size() < 2) return std::nullopt;
  const Largest deflection = largest(
      moments, [](const Pose& moment) -> const std::vector<Point>& { return moment.displacement; });
  const double factor = magnification(deflection.length, box_around({drawing.nodes}, 0, 0).side());
  std::vector<std::vector<Point>> places, everything;
  for (const Pose& moment : moments) {
    everything.push_back(moment.nodes);
    places.push_back(moment.nodes);
    if (!moment.displacement.empty())
      places.back() = displaced(moment.nodes, {moment.label, moment.displacement}, factor);
    everything.push_back(places.back());
  }
  const Box box = box_around(everything, 0.04, 0.22);
  PlotScript script;
  frame(script, box);
  script.axis_label("x", "x (m)");
  script.axis_label("y", "y (m)");
  const std::size_t stride = (moments.size() + kMaxDrawnMoments - 2) / (kMaxDrawnMoments - 1);
  std::string drawn;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const bool last = k + 1 == moments.size();
    if (k % stride != 0 && !last) continue;
    drawn += (k == 0 ? "" : ", ") + trimmed(*moments[k].time_s, 3);
    draw_body(script, drawing, moments[k].nodes, palette::kStructure, 1);
    draw_body(script, drawing, places[k], palette::color(0), k == 0 ? 2.4 : 1.1);
  }
  script.plot();
  const std::string caption =
      caption_of(moments, deflection, factor, drawn + "\u202fs (thick: first)");
  return Figure{.id = slug(info.id + "-" + run.variant + "-motion"),
                .title = titled("Motion", info, run),
                .caption = caption,
                .alt = "Outlines of the mechanism at a few moments. " + caption,
                .height = height_of(box),
                .commands = script.commands(),
                .data = table_of(moments),
                .moving = moving_poses(drawing, moments, factor, box, 500)};
}

}  // namespace trammel::reports
