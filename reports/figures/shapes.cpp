#include <fmt/format.h>

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
constexpr double kRigid = 1e-4;  ///< limit for rigid-body modes: frequency / highest frequency

double magnification_of_shape(const Shape& shape, double side) {
  double largest = 0;
  for (const auto& [ux, uy] : shape.displacement) largest = std::max(largest, std::hypot(ux, uy));
  return largest > 0 && std::isfinite(largest) ? kDrawnAmplitude * side / largest : 0;
}

/// Position of the drawing of one shape in the figure [px], with y downwards. The box around the
/// shapes is scaled to the width of the panel.
struct Panel {
  Box box;
  double left, top, width;

  /// Returns the attribute `d` of an SVG path along polylines of node numbers.
  [[nodiscard]] std::string path(const std::vector<std::vector<int>>& lines,
                                 const std::vector<Point>& nodes) const {
    const double scale = width / box.width();
    std::string out;
    for (const auto& line : lines)
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (i % (1 + line.size() / 200) != 0 && i + 1 != line.size()) continue;  // up to 200 points
        const auto& [x, y] = nodes[static_cast<std::size_t>(line[i])];
        out += fmt::format("{}{:.4g},{:.4g}", i == 0 ? 'M' : ' ', left + scale * (x - box.x.low),
                           top + scale * (box.y.high - y));
      }
    return out;
  }
};

/// Draws the undeformed and the deformed body. The deformed body swings between the shape and its
/// mirror image while the drawing has the mouse pointer or the keyboard focus.
/// @param half_period_s  time from the shape to its mirror image; 0: the body does not swing
/// @param name           unique name of the drawing
/// @param motion         the CSS of the animation is appended to this text
std::string shape_panel_svg(const Drawing& drawing, const Shape& shape, double factor,
                            double half_period_s, const std::string& name, std::size_t panels,
                            const Panel& panel, std::string& motion) {
  const std::vector<Point> there = moved_nodes(drawing.nodes, shape, factor),
                           back = moved_nodes(drawing.nodes, shape, -factor);
  std::string out = fmt::format("<text x=\"{:.4g}\" y=\"{:.4g}\" fill=\"{}\">{}</text>\n",
                                panel.left + 0.5 * panel.width, panel.top - 10, palette::kInk,
                                xml_escaped(with_powers_of_ten(shape.label)));
  const auto draw = [&](const std::vector<std::vector<int>>& lines, double width,
                        const std::string& part, const std::string& style = "") {
    if (lines.empty()) return;
    const bool swings = half_period_s > 0 && !part.empty();
    const std::string own = "swing-" + slug(name) + "-" + part;
    if (swings)
      motion += fmt::format("<style>@keyframes {}{{to{{d:path('{}')}}}}</style>\n", own,
                            panel.path(lines, back));
    out += fmt::format(R"(<path d="{}" stroke="{}" stroke-width="{}"{})",
                       panel.path(lines, part.empty() ? drawing.nodes : there),
                       part.empty() ? palette::kStructure : palette::color(0), width, style);
    if (swings)
      out += fmt::format(R"( class="swing" style="--swing:{} {:.3g}s")", own, half_period_s);
    out += "/>\n";
  };
  draw(triangle_edges(drawing), 0.6, "");
  draw(polylines(drawing), 1.2, "");
  draw(filled_loops(drawing), 1.1, "plate",
       fmt::format(R"( fill-rule="evenodd" fill="{}")", palette::kPlate));
  draw(triangle_edges_inside(drawing, panels), 0.4, "mesh");
  draw(polylines(drawing), 2.2, "links");
  return out;
}

/// Returns true if a shape is a vibration mode, which has a label such as "mode 3, 15.1 Hz".
bool is_mode(const Shape& shape) {
  return shape.label.starts_with("mode") && shape.label.find(" Hz") != std::string::npos;
}

/// Returns the frequencies of `n` vibration modes [Hz]. Empty if the shapes are no vibration modes,
/// or if any of the frequencies is missing.
std::vector<double> mode_frequencies(const Drawing& drawing, std::size_t n, const Run& run) {
  const auto* frequency = run.quantity("frequency_Hz");
  std::vector<double> values;
  for (std::size_t s = 0; frequency && s < std::min(n, frequency->size()); ++s)
    if (Number((*frequency)[s]) && is_mode(drawing.shapes[s]) &&
        are_finite_points(drawing.shapes[s].displacement))
      values.push_back((*frequency)[s]);
  return values.size() == n && are_finite_points(drawing.nodes) ? values : std::vector<double>();
}

/// Returns "1 mode is a rigid-body mode. Modes 2 to 6 have 15.1 Hz to 98.3 Hz."
std::string modes_text(const Drawing& drawing, const std::vector<double>& values) {
  if (!is_mode(drawing.shapes.front())) {
    const std::string label = drawing.shapes.front().label;
    return "The lowest buckling mode is at " + label.substr(label.find(", ") + 2) + ".";
  }
  const std::size_t n = values.size();
  if (n == 0) return "";
  std::size_t free = 0;
  while (free < n && values[free] <= kRigid * values.back()) ++free;
  const auto hertz = [](double value) { return trimmed(value, 4) + "\u202fHz"; };
  std::string text;
  if (free > 0) text = count(free, "mode is a rigid-body mode", "modes are rigid-body modes") + ".";
  if (free == n) return text;
  const bool one = free + 1 == n;
  return text + (one ? " Mode " : " Modes ") +
         limits_text(std::to_string(free + 1), std::to_string(n)) + (one ? " has " : " have ") +
         limits_text(hertz(values[free]), hertz(values.back())) + ".";
}

/// Returns "The largest displacement is 1.2 mm, magnified 83 times."
std::string displacements_text(const Drawing& drawing, const std::vector<double>& factors,
                               double side) {
  const auto size = [](double factor) { return factor > 0 ? 1 / factor : 0; };
  const auto largest = std::ranges::max_element(factors, {}, size) - factors.begin();
  if (!(factors[largest] > 0)) return "All displacements are zero.";
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
    const double factor = magnification_of_shape(shape, side);
    factors.push_back(factor);
    moved.push_back(moved_nodes(drawing.nodes, shape, factor));
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
  constexpr double kWidth = 500, kHeadline = 32, kMaxHeight = 270;
  const double cell = kWidth / static_cast<double>(columns), aspect = box.height() / box.width();
  const double width = std::min(cell, kMaxHeight / aspect), high = width * aspect + kHeadline;
  const std::vector<double> hertz = mode_frequencies(drawing, n, run);
  const double fastest = hertz.empty() ? 0 : std::ranges::max(hertz);
  double slowest = fastest;
  for (const double f : hertz) slowest = f > kRigid * fastest ? std::min(slowest, f) : slowest;
  const double slowed = std::max(2 * slowest, 0.25 * fastest);  // lowest <= 0.5 Hz, highest <= 4 Hz
  std::string svg, motion;
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t row = s / columns;
    svg += shape_panel_svg(drawing, drawing.shapes[s], factors[s],
                           slowed > 0 && hertz[s] > kRigid * fastest ? 0.5 * slowed / hertz[s] : 0,
                           info.id + "-" + run.variant + "-" + std::to_string(s), n,
                           {box, cell * static_cast<double>(s % columns) + 0.5 * (cell - width),
                            high * static_cast<double>(row) + kHeadline, width},
                           motion);
  }

  const bool modes = drawing.shapes.front().label.starts_with("mode");
  std::string labels;
  for (std::size_t s = 0; s < n; ++s) add_item(labels, drawing.shapes[s].label, "; ");
  const std::string title = titled(modes ? "Mode shapes" : "Deformed shapes", info, run);
  const std::string alt = "Drawings of the shapes: " + labels;
  const int height = static_cast<int>(high * static_cast<double>(rows)) + 8;
  return Figure{
      .id = slug(info.id + "-" + run.variant + "-shapes"),
      .title = title,
      .caption =
          "Undeformed (gray) and deformed (blue) shapes, each scaled so that its largest "
          "displacement is " +
          trimmed(100 * kDrawnAmplitude, 2) + "\u202f% of the longer side. " +
          (modes ? modes_text(drawing, hertz) : displacements_text(drawing, factors, side)) +
          (slowed > 0
               ? " Hover or focus shows the motion, slowed down " + trimmed(slowed, 2) + " times."
               : ""),
      .alt = alt,
      .height = height,
      .data = std::move(table),
      .svg = svg_element("0 0 500 " + std::to_string(height), title + ". " + alt, svg + motion,
                         slowed > 0 ? R"( tabindex="0")" : "")};
}

}  // namespace trammel::reports
