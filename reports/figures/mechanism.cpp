#include "reports/figures/mechanism.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

struct JointSymbol {
  const char *kind, *words;
  int point;
  double size;
  bool filled;
};

constexpr std::array<JointSymbol, 7> kJointSymbols = {{
    {"point", "", 7, 0.6, true},
    {"support", "support", 9, 1.3, true},
    {"rigid", "rigid body", 5, 0.9, true},
    {"welded", "welded joint", 5, 0.8, true},
    {"sprung", "joint on a spring", 13, 1.2, true},
    {"hinged", "hinge", 7, 0.95, false},
    {"active", "active joint", 7, 1.1, true},
}};

const char* joint_color(const JointSymbol& symbol) {
  return std::string(symbol.kind) == "active" ? palette::color(1) : palette::kInk;
}

bool is_drawn(const Drawing& drawing, const JointSymbol& symbol) {
  return std::any_of(drawing.joints.begin(), drawing.joints.end(),
                     [&](const Joint& joint) { return joint.kind == symbol.kind; });
}

/// Joints of one kind; a hinge is a ring with paper inside.
void draw_joints(PlotScript& script, const Drawing& drawing, const JointSymbol& symbol) {
  PlotScript::Rows rows;
  for (const Joint& joint : drawing.joints)
    if (joint.kind == symbol.kind)
      rows.push_back({drawing.nodes[joint.node].first, drawing.nodes[joint.node].second});
  if (rows.empty()) return;
  const std::string style = "with points pt " + std::to_string(symbol.point) + " ps " +
                            shortest(symbol.size) + lc(joint_color(symbol));
  script.curve(rows, style, symbol.filled ? symbol.words : "");
  if (symbol.filled) return;
  script.curve(rows, "with points pt 7 ps " + shortest(0.6 * symbol.size) + lc(palette::kPaper));
  script.key_entry("with points pt 6 ps 1 lw 2" + lc(palette::kInk), symbol.words);
}

/// Names stand outside: away from the middle of the drawing.
void name_joints(PlotScript& script, const Drawing& drawing, const Box& box) {
  const double cx = 0.5 * (box.x0 + box.x1);
  const double cy = 0.5 * (box.y0 + box.y1);
  std::set<std::string> named;
  for (const Joint& joint : drawing.joints) {
    if (joint.name.empty() || !named.insert(joint.name).second) continue;
    const auto& [x, y] = drawing.nodes[joint.node];
    const double r = std::hypot(x - cx, y - cy) + 1e-300;
    const double reach = 0.055 * std::max(box.width(), box.height());
    const double lift = r < reach ? reach : 0;
    script.label(joint.name, shortest(x + reach * (x - cx) / r) + "," +
                                 shortest(y + reach * (y - cy) / r + lift) +
                                 " center front textcolor rgb '" + palette::kInk + "'");
  }
}

void draw_body(PlotScript& script, const Drawing& drawing, const std::vector<Point>& nodes,
               const std::string& color, double width, const std::string& title) {
  const std::string line = "with lines lw " + shortest(width) + lc(color);
  script.curve(rows_of(triangle_edges_inside(drawing), nodes), "with lines lw 0.4" + lc(color));
  script.curve(rows_of(triangle_edges(drawing), nodes),
               "with lines lw " + shortest(0.5 * width) + lc(color),
               drawing.members.empty() ? title : "");
  script.curve(rows_of(polylines(drawing), nodes), line, title);
}

void add_rows(Table& table, const std::string& pose, const Drawing& drawing,
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
  std::string text = "The model as it was solved; it spans " + trimmed(box.width(), 3) + "\u202fm";
  if (box.height() > 0) text += " × " + trimmed(box.height(), 3) + "\u202fm";
  text += ".";
  if (poses > 1) text += " " + std::to_string(poses) + " poses are laid over each other.";
  return text;
}

}  // namespace

std::optional<Figure> mechanism_figure(
    const CaseInfo& info, const Run& run,
    const std::vector<std::pair<std::string, const Drawing*>>& further) {
  if (!run.drawing || run.drawing->nodes.empty()) return std::nullopt;
  const Drawing& drawing = *run.drawing;
  // Points alone, as of a mass on springs, are no picture.
  if (drawing.members.empty() && drawing.triangles.empty() && drawing.joints.empty()) {
    return std::nullopt;
  }
  std::vector<Pose> poses;  // moments of a motion have a figure of their own
  std::ranges::copy_if(drawing.poses, std::back_inserter(poses),
                       [](const Pose& pose) { return !pose.time_s; });
  std::vector<std::vector<Point>> sets = {drawing.nodes};
  for (const Pose& pose : poses) sets.push_back(pose.nodes);
  for (const auto& [_, other] : further) sets.push_back(other->nodes);
  const Box box = box_around(sets, 0.09, 0.2);

  PlotScript script;
  frame(script, box);
  script.axis_label("x", "x (m)");
  script.axis_label("y", "y (m)");
  const std::string base_label = sets.size() == 1 ? ""
                                 : poses.empty()  ? info.variant_title(run.variant)
                                                  : "first pose";
  std::vector<std::string> titles;
  for (const Pose& pose : poses) titles.push_back(pose.label);
  for (const auto& [label, _] : further) titles.push_back(label);
  if (!titles.empty()) titles.push_back(base_label);
  for (const JointSymbol& symbol : kJointSymbols)
    if (is_drawn(drawing, symbol)) titles.emplace_back(symbol.words);
  const int key_height = script.key_below(titles);
  Figure figure;
  figure.data.heads = {"pose", "node", "x_m", "y_m", "joint", "name"};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& pose = poses[i];
    draw_body(script, drawing, pose.nodes, palette::color(2 + i), 1.2, pose.label);
    add_rows(figure.data, pose.label, drawing, pose.nodes);
  }
  for (std::size_t i = 0; i < further.size(); ++i) {
    const auto& [label, other] = further[i];
    draw_body(script, *other, other->nodes, palette::color(2 + i), 1.2, label);
    add_rows(figure.data, label, *other, other->nodes);
  }
  script.curve(filled_triangles(drawing, drawing.nodes),
               "with filledcurves closed" + lc(palette::kPlate));
  draw_body(script, drawing, drawing.nodes, palette::color(0), 2.6, base_label);
  add_rows(figure.data, base_label.empty() ? "pose" : base_label, drawing, drawing.nodes);
  for (const JointSymbol& symbol : kJointSymbols) draw_joints(script, drawing, symbol);
  name_joints(script, drawing, box_around({drawing.nodes}, 0, 0));
  script.plot();

  const Box tight = box_around(sets, 0, 0);
  figure.id = slug(info.id + "-" + run.variant + "-mechanism");
  figure.title = titled("Geometry", info, run);
  figure.caption = mechanism_caption(tight, sets.size());
  figure.alt = "Drawing of the model with its joints. " + figure.caption;
  const double drawn = 410.0 * box.height() / box.width();
  figure.height = static_cast<int>(std::clamp(drawn, 90.0, 470.0)) + 80 + key_height;
  figure.commands = script.commands();
  return figure;
}

}  // namespace trammel::reports
