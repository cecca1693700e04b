#pragma once

#include <vector>

#include "solver/sensitivity/sensitivity_map.h"

/// Curves in the plane of positions, for one orientation of the platform.
namespace trammel::solver {

using Polyline = std::vector<Vector2d>;  ///< (x, y) of P [m]

/// Where the reach ends: arcs on which one limb is straight or folded (serial singularities) and
/// the others are within reach.
/// @param points  of a whole circle
[[nodiscard]] std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry,
                                                       double phi, Index points);

/// Where det J_x = 0 within reach, as a segment a cell of the grid, from one side of the cell to
/// another; the ends are exact, and the curve is straight in between. Only sides that lie
/// within reach.
[[nodiscard]] std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                                           const PoseGrid& grid);

}  // namespace trammel::solver
