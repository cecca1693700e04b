#pragma once

#include "solver/large_motion/system/system_parts.h"

/// Elements with a strain energy of their coordinates alone.
namespace trammel::solver::large_motion {

/// Adds the triangles of the model's plates with their masses.
/// @throws ModelError  where one has no area.
void add_triangles(const Model& model, const Layout& layout, SystemParts& parts);

/// Adds springs on nodes and in sprung member ends.
void add_coordinate_springs(const Model& model, const Layout& layout, SystemParts& parts);

}  // namespace trammel::solver::large_motion
