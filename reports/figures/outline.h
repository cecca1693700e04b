#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/plot_script.h"

/// Lines of a drawing, rows of labels, and what moves a drawing.
namespace trammel::reports {

/// Lines of a drawing through given node positions.

/// Members joined end to end into as few polylines as their order allows.
[[nodiscard]] std::vector<std::vector<int>> polylines(const Drawing& drawing);

/// Edges to draw of the triangles: all of a coarse mesh, the outline of a fine one.
[[nodiscard]] std::vector<std::vector<int>> triangle_edges(const Drawing& drawing);

/// The other edges, for thin lines: none of a coarse mesh, and none of one too fine to be seen
/// where a figure has so many panels.
[[nodiscard]] std::vector<std::vector<int>> triangle_edges_inside(const Drawing& drawing,
                                                                  std::size_t panels = 1);

/// Rows of (x, y), polylines apart by an empty row.
[[nodiscard]] PlotScript::Rows rows_of(const std::vector<std::vector<int>>& lines,
                                       const std::vector<Point>& nodes);

/// Triangles as closed polygons, or their outline as one, for filling.
[[nodiscard]] PlotScript::Rows filled_triangles(const Drawing& drawing,
                                                const std::vector<Point>& nodes);

/// Node positions moved by `factor` times a shape's displacements.
[[nodiscard]] std::vector<Point> displaced(const std::vector<Point>& nodes, const Shape& shape,
                                           double factor);

/// The smallest box around all points, never thinner than `min_aspect` times its longer side.
struct Box {
  Interval x, y;
  [[nodiscard]] double width() const { return x.length(); }
  [[nodiscard]] double height() const { return y.length(); }
  [[nodiscard]] double side() const { return std::max(width(), height()); }  ///< the longer one
};
[[nodiscard]] Box box_around(const std::vector<std::vector<Point>>& sets, double margin,
                             double min_aspect);

/// 1, 2 or 5 times a power of ten, not below `min_step`.
[[nodiscard]] double round_step(double min_step);
/// Sets ranges and an equal scale on both axes.
void frame(PlotScript& script, const Box& box);

/// Height of a drawing of its own that has room for the box, its axes included [px].
[[nodiscard]] int height_of(const Box& box);

/// A title with the variant's behind it, unless it is the case as it stands.
[[nodiscard]] std::string titled(const std::string& what, const CaseInfo& info, const Run& run);

// The moving parts of a drawing are JSON for the page's script: a panel in tenths of a unit of the
// drawing, y downwards, with the lines through the nodes that are drawn.

inline constexpr double kDrawnAmplitude = 0.13;  ///< of the longer side: deflections magnified

[[nodiscard]] bool are_finite(const std::vector<Point>& points);

/// Modes to swing, a panel each: displacements as they are drawn.
/// @param factor  of each shape
/// @param panel   its width [px]
[[nodiscard]] std::string moving_modes(const Drawing& drawing, const std::vector<double>& factor,
                                       const Box& box, double panel);

/// Moments of a motion: places at rest (only where they differ) and displaced, each less those of
/// the moment before.
/// @param moments  with times
[[nodiscard]] std::string moving_poses(const Drawing& drawing, const std::vector<Pose>& moments,
                                       double factor, const Box& box, double panel);

}  // namespace trammel::reports
