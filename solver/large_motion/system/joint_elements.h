#pragma once

#include "solver/large_motion/system/system_parts.h"

/// Rigid bodies, joints and drives as constraint rows (joints.h).
namespace trammel::solver::large_motion {

/// Adds point masses, and the rigid links from nodes to masses with an offset and to the nodes of
/// rigid bodies.
void add_rigid_links(const Model& model, const Layout& layout, SystemParts& parts);

/// Adds the lines of sliders; a slider that keeps its angle has a second row
/// (`add_linear_constraints`).
void add_sliders(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                 SystemParts& parts);

void add_line_springs(const Model& model, const LargeMotionModel& large_motion,
                      const Layout& layout, SystemParts& parts);

/// Adds one row a drive, in their order.
void add_drives(const LargeMotionModel& large_motion, const Layout& layout, SystemParts& parts);

/// @param blocks  coordinates and rows that each element couples, the drives' own among them
/// @param mass    of each coordinate
/// @throws ModelError  where a drive moves a coordinate to which nothing is joined.
void require_driven_parts(const Model& model, const LargeMotionModel& large_motion,
                          const Layout& layout, const std::vector<std::vector<Index>>& blocks,
                          const VectorXd& mass);

}  // namespace trammel::solver::large_motion
