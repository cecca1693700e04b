#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Symbol of one type of joint: gnuplot point type, and text in the legend.
struct JointSymbol {
  const char *kind, *words;
  int point;
  double size;
  bool filled = true;
  const char* color = palette::kInk;
};

constexpr std::array<JointSymbol, 7> kJointSymbols = {{
    {"point", "", 7, 0.6},
    {"support", "support", 9, 1.3},
    {"rigid", "rigid body", 5, 0.9},
    {"welded", "welded joint", 5, 0.8},
    {"sprung", "joint on a spring", 13, 1.2},
    {"hinged", "hinge", 7, 0.95, false},
    {"active", "active joint", 7, 1.1, true, palette::kSeries[1]},
}};

/// Draws the joints of one type. A hinge is a ring that is filled with the background color.
void draw_joints(PlotScript& script, const Drawing& drawing, const JointSymbol& symbol) {
  PlotScript::Rows rows;
  for (const Joint& joint : drawing.joints)
    if (joint.kind == symbol.kind)
      rows.push_back({drawing.nodes[joint.node].first, drawing.nodes[joint.node].second});
  if (rows.empty()) return;
  const std::string style = "with points pt " + std::to_string(symbol.point) + " ps " +
                            shortest_decimal(symbol.size) + lc(symbol.color);
  script.curve(rows, style, symbol.filled ? symbol.words : "");
  if (symbol.filled) return;
  script.curve(rows,
               "with points pt 7 ps " + shortest_decimal(0.6 * symbol.size) + lc(palette::kPaper));
  script.key_entry("with points pt 6 ps 1 lw 2" + lc(palette::kInk), symbol.words);
}

/// Writes a text centered at a point.
void write_at(PlotScript& script, double x, double y, const std::string& text, const char* color) {
  script.label(text, shortest_decimal(x) + "," + shortest_decimal(y) +
                         " center front textcolor rgb '" + color + "'");
}

/// Writes the name of each joint next to the joint, on the side that faces away from the center of
/// the drawing.
void write_joint_names(PlotScript& script, const Drawing& drawing, const Box& box) {
  const double cx = 0.5 * (box.x.low + box.x.high), cy = 0.5 * (box.y.low + box.y.high);
  std::set<std::string> named;
  for (const Joint& joint : drawing.joints) {
    if (joint.name.empty() || !named.insert(joint.name).second) continue;
    const auto& [x, y] = drawing.nodes[joint.node];
    const double r = std::hypot(x - cx, y - cy) + 1e-300, reach = 0.055 * box.side();
    const double lift = r < reach ? reach : 0;
    write_at(script, x + reach * (x - cx) / r, y + reach * (y - cy) / r + lift, joint.name,
             palette::kInk);
  }
}

/// Draws dimension lines with the lengths of straight members, or of the edges of a model without
/// members. Each dimension line is on the side that faces away from the center of the drawing.
/// Equal lengths have one dimension line. Lengths below 0.12 of the longer side of the drawing have
/// no dimension line.
void draw_dimensions(PlotScript& script, const Drawing& drawing, const Box& box) {
  constexpr std::size_t kMaxDimensions = 6;
  const double cx = 0.5 * (box.x.low + box.x.high), cy = 0.5 * (box.y.low + box.y.high);
  std::set<std::string> lengths;
  const PlotScript::Rows lines = polyline_points(
      drawing.members.empty() ? triangle_edges(drawing) : polylines(drawing), drawing.nodes);
  for (std::size_t i = 1; i < lines.size() && lengths.size() < kMaxDimensions; ++i) {
    if (lines[i].empty() || lines[i - 1].empty()) continue;
    const double x = lines[i - 1][0], y = lines[i - 1][1], dx = lines[i][0] - x;
    const double dy = lines[i][1] - y, length = std::hypot(dx, dy);
    const std::string text = trimmed(length, 3) + "\u202fm";
    if (length < 0.12 * box.side() || !lengths.insert(text).second) continue;
    const double gap = 0.04 * box.side() / length;
    const double turned = std::copysign(gap, dx * (cy - y) - dy * (cx - x));
    const double nx = turned * dy, ny = -turned * dx;
    script.curve({{x + nx, y + ny, dx, dy}},
                 "with vectors heads size graph 0.012,20 lw 1" + lc(palette::kMuted));
    write_at(script, x + 0.5 * dx + 2.6 * nx, y + 0.5 * dy + 2.6 * ny, text, palette::kMuted);
  }
}

/// Arrows of all loads with the same unit (N or N/m), with their tips at the loaded nodes.
struct LoadArrows {
  PlotScript::Rows rows = {};  ///< x, y, dx, dy
  std::string title = {};
};
LoadArrows load_arrows(const Drawing& drawing, const std::string& unit, double length) {
  LoadArrows arrows;
  double largest = 0;
  for (const DrawnForce& force : drawing.forces) {
    const double size = std::hypot(force.x, force.y), scale = length / size;
    if (force.unit != unit || size == 0) continue;
    const auto& [x, y] = drawing.nodes[force.node];
    const double dx = scale * force.x, dy = scale * force.y;
    arrows.rows.push_back({x - dx, y - dy, dx, dy});
    largest = std::max(largest, size);
  }
  arrows.title = "load of " + trimmed(largest, 3) + "\u202f" + unit;
  return arrows;
}

void add_rows_of_drawing(Table& table, const std::string& pose, const Drawing& drawing,
                         const std::vector<Point>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::string kind, name;
    for (const Joint& joint : drawing.joints)
      if (joint.node == static_cast<int>(i)) kind = joint.kind, name = joint.name;
    table.rows.push_back(
        {pose, static_cast<double>(i), nodes[i].first, nodes[i].second, kind, name});
  }
}

std::string mechanism_caption(const Box& box, std::size_t poses) {
  std::string text = "Model as solved";
  if (poses > 1) text += " in " + std::to_string(poses) + " poses";
  text += ". It spans " + trimmed(box.width(), 3) + "\u202fm";
  if (box.height() > 0) text += " × " + trimmed(box.height(), 3) + "\u202fm";
  return text + ".";
}

/// Draws the poses of a mechanism other than the first pose, and the legend of poses, joints and
/// loads. @returns the height of the legend [px]
int draw_further_poses(PlotScript& script, Table& data, const std::vector<const Pose*>& overlays,
                       const std::string& base_label, const Drawing& drawing,
                       const std::vector<LoadArrows>& loads) {
  std::vector<std::string> titles;
  for (const Pose* pose : overlays) titles.push_back(pose->label);
  if (!titles.empty()) titles.push_back(base_label);
  for (const JointSymbol& symbol : kJointSymbols)
    if (std::ranges::count(drawing.joints, symbol.kind, &Joint::kind) > 0)
      titles.emplace_back(symbol.words);
  for (const LoadArrows& arrows : loads) titles.push_back(arrows.title);
  for (std::size_t i = 0; i < overlays.size(); ++i) {
    draw_body(script, drawing, overlays[i]->nodes, palette::color(2 + i), 1.2, overlays[i]->label);
    add_rows_of_drawing(data, overlays[i]->label, drawing, overlays[i]->nodes);
  }
  return script.place_key_below(titles);
}

}  // namespace

std::optional<Figure> mechanism_figure(const CaseInfo& info, const Run& run) {
  if (!run.drawing || run.drawing->nodes.empty()) return std::nullopt;
  const Drawing& drawing = *run.drawing;
  // A model without members, triangles and joints, such as a mass on springs, has no drawing.
  if (drawing.members.empty() && drawing.triangles.empty() && drawing.joints.empty())
    return std::nullopt;
  std::vector<const Pose*> overlays;
  for (const Pose& pose : drawing.poses)
    if (!pose.time_s) overlays.push_back(&pose);  // a motion has a separate figure
  std::vector<std::vector<Point>> sets = {drawing.nodes};
  for (const Pose* pose : overlays) sets.push_back(pose->nodes);
  const std::string base_label = overlays.empty() ? "" : "first pose";
  const Box extent = box_around(sets, 0, 0);
  std::vector<LoadArrows> loads = {load_arrows(drawing, "N", 0.14 * extent.side()),
                                   load_arrows(drawing, "N/m", 0.07 * extent.side())};
  std::erase_if(loads, [](const LoadArrows& arrows) { return arrows.rows.empty(); });
  for (const LoadArrows& arrows : loads)
    for (const auto& row : arrows.rows) sets.push_back({{row[0], row[1]}});
  PlotScript script;
  const Box box = box_around(sets, 0.12, 0.2);
  set_axis_ranges(script, box);
  Table table{words_in("pose node x_m y_m joint name"), {}, kSampleDigits};
  const int key_height = draw_further_poses(script, table, overlays, base_label, drawing, loads);
  script.curve(filled_triangles(drawing, drawing.nodes),
               "with filledcurves closed" + lc(palette::kPlate));
  script.curve(polyline_points(triangle_edges_inside(drawing), drawing.nodes),
               "with lines lw 0.4" + lc(palette::color(0)));
  draw_body(script, drawing, drawing.nodes, palette::color(0), 2.6, base_label);
  add_rows_of_drawing(table, base_label.empty() ? "pose" : base_label, drawing, drawing.nodes);
  for (const JointSymbol& symbol : kJointSymbols) draw_joints(script, drawing, symbol);
  for (const LoadArrows& arrows : loads)
    script.curve(arrows.rows, "with vectors filled lw 2" + lc(palette::kSeries[1]), arrows.title);
  const Box body = box_around({drawing.nodes}, 0, 0);
  write_joint_names(script, drawing, body);
  draw_dimensions(script, drawing, body);
  script.plot();

  const std::string caption = mechanism_caption(extent, overlays.size() + 1);
  return Figure{.id = slug(info.id + "-" + run.variant + "-mechanism"),
                .title = titled("Geometry", info, run),
                .caption = caption,
                .alt = "Drawing of the model with its joints. " + caption,
                .height = drawing_height(box) + key_height,
                .commands = script.commands(),
                .data = std::move(table)};
}

}  // namespace trammel::reports
