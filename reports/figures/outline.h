#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/plot_script.h"

/// Geometry of drawings of models: lines, filled areas, and ranges of the axes.
namespace trammel::reports {

/// Returns the members of a drawing as polylines of node numbers. A member that starts at the end
/// of the previous member extends the polyline of that member.
[[nodiscard]] std::vector<std::vector<int>> polylines(const Drawing& drawing);

/// Returns all edges of a mesh of up to 12 triangles, or the outline of a finer mesh, as polylines
/// of node numbers.
[[nodiscard]] std::vector<std::vector<int>> triangle_edges(const Drawing& drawing);

/// Returns the edges of triangles inside the outline of a mesh. Empty for a mesh of up to 12
/// triangles, and for a mesh too fine to be visible in a figure with this number of panels.
[[nodiscard]] std::vector<std::vector<int>> triangle_edges_inside(const Drawing& drawing,
                                                                  std::size_t panels = 1);

/// Returns rows of (x, y), with an empty row between polylines.
[[nodiscard]] PlotScript::Rows polyline_points(const std::vector<std::vector<int>>& lines,
                                               const std::vector<Point>& nodes);

/// Returns closed loops of node numbers: the triangles of a mesh of up to 12 triangles, or the
/// outline of a finer mesh.
[[nodiscard]] std::vector<std::vector<int>> filled_loops(const Drawing& drawing);

/// Returns the data rows with which gnuplot fills the loops of `filled_loops`.
[[nodiscard]] PlotScript::Rows filled_triangles(const Drawing& drawing,
                                                const std::vector<Point>& nodes);

/// Returns the node positions plus `factor` times the displacements of a mode shape or deformed
/// shape.
[[nodiscard]] std::vector<Point> moved_nodes(const std::vector<Point>& nodes, const Shape& shape,
                                             double factor);

/// Smallest box around points.
struct Box {
  Interval x, y;
  [[nodiscard]] double width() const { return x.length(); }
  [[nodiscard]] double height() const { return y.length(); }
  [[nodiscard]] double side() const { return std::max(width(), height()); }  ///< longer side
};
/// Returns the smallest box around all points, enlarged by a margin.
/// @param margin      width of the margin around the points, relative to the longer side of the box
/// @param min_aspect  smallest ratio of the shorter to the longer side, before the margin
[[nodiscard]] Box box_around(const std::vector<std::vector<Point>>& sets, double margin,
                             double min_aspect);

/// Returns the smallest number of at least `min_step` that is 1, 2 or 5 times a power of ten.
[[nodiscard]] double tick_spacing(double min_step);
/// Sets the ranges of the axes x and y (m) to the box, with the same scale.
void set_axis_ranges(PlotScript& script, const Box& box);

/// Returns the height of a drawing of the box, including the axes [px].
[[nodiscard]] int drawing_height(const Box& box);

/// Draws members with the line width `width`, and edges of triangles with half of this line width.
void draw_body(PlotScript& script, const Drawing& drawing, const std::vector<Point>& nodes,
               const std::string& color, double width, const std::string& title = "");

/// Returns the title `what`, followed by the title of the variant if it is not the base variant.
[[nodiscard]] std::string titled(const std::string& what, const CaseInfo& info, const Run& run);

inline constexpr double kDrawnAmplitude = 0.13;  ///< largest drawn deflection / longer box side

[[nodiscard]] bool are_finite_points(const std::vector<Point>& points);

}  // namespace trammel::reports
