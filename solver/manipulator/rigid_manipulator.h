#pragma once

#include <array>

#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

struct RigidLink {
  double mass = 0;     ///< [kg]
  double center = 0;   ///< of mass, from the link's first joint along it [m]
  double inertia = 0;  ///< about the centre of mass [kg m^2]
};

struct RigidManipulator {
  ManipulatorGeometry geometry;
  std::array<RigidLink, 3> proximal, distal;
  PlatformMass platform;
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]
};

/// The bodies of a design. A link's inertia about its centre is the printed one, or m L^2 / 12.
/// (The flexible model spreads the mass over the length, which has that inertia by itself, and
/// carries a printed one on top, half at each end.)
/// @throws ModelError  as `link_section` and `platform_mass`.
[[nodiscard]] RigidManipulator rigid_manipulator(const ManipulatorDesign& design);

}  // namespace trammel::solver
