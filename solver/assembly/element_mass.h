#pragma once

#include "solver/assembly/system.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"

namespace trammel::solver {

/// Mass of a frame element in world axes.
[[nodiscard]] inline Matrix6d world_mass(const FrameElement& e, const Member& member) {
  if (e.is_bar()) return bar_mass(e.section, member.mass, e.length);
  const Matrix6d R = frame_rotation(e.direction);
  return R.transpose() * frame_mass(e.section, member.theory, member.mass, e.length) * R;
}

/// Calls visit(coordinates, mass matrix) for every triangle.
template <class Visit>
void for_each_plate_mass(const System& system, Visit&& visit) {
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    visit_nodes(system.model, triangle, [&]<std::size_t n>(const TriangleNodes<n>& nodes) {
      visit(system.coordinates.of_triangle<2 * n>(triangle), triangle_mass(nodes, plate));
    });
  }
}

}  // namespace trammel::solver
