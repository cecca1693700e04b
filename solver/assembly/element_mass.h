#pragma once

#include "solver/assembly/system.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle6_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/quadrature.h"

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
  const Model& model = system.model;
  for (const Triangle& triangle : model.triangles) {
    if (triangle.quadratic()) {
      visit(system.coordinates.of_triangle<12>(triangle), triangle6_mass(model, triangle));
    } else {
      visit(system.coordinates.of_triangle<6>(triangle),
            triangle_mass(corners(model, triangle),
                          model.plates[static_cast<std::size_t>(triangle.plate)]));
    }
  }
}

}  // namespace trammel::solver
