#include "solver/manipulator/rigid_manipulator.h"

namespace trammel::solver {

namespace {

RigidLink rigid_link(const LinkDesign& link, double length) {
  const double mass = link_section(link, length).mass_per_length * length;
  return {mass, length / 2, link.inertia.value_or(mass * length * length / 12)};
}

}  // namespace

RigidManipulator rigid_manipulator(const ManipulatorDesign& design) {
  check_geometry(design.geometry);
  RigidManipulator m;
  m.geometry = design.geometry;
  for (std::size_t k = 0; k < 3; ++k) {
    m.proximal[k] = rigid_link(design.proximal[k], design.geometry.proximal[k]);
    m.distal[k] = rigid_link(design.distal[k], design.geometry.distal[k]);
  }
  m.platform = platform_mass(design);
  return m;
}

}  // namespace trammel::solver
