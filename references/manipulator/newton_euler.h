#pragma once

#include <array>

#include "references/frames/manipulator_design.h"
#include "references/numerics/jet.h"

/// Inverse dynamics of the planar 3-RRR by the laws of Newton and Euler for each of its seven
/// bodies cut free: 21 equations for the forces in the nine joints and the three torques. Motions
/// are differentiated by carrying derivatives along (Jet); no Lagrangian, no Jacobian, no mass
/// matrix.
namespace trammel::references {

struct LinkBody {
  Real mass = 0;
  Real center = 0;   ///< of mass, from the link's first joint along it
  Real inertia = 0;  ///< about the centre of mass
};

struct LimbBodies {
  Point2<Real> base;    ///< A
  Point2<Real> corner;  ///< C from P, in platform axes
  Real proximal_length = 0, distal_length = 0;
  int mode = -1;  ///< side of the elbow, as in `elbow`
  LinkBody proximal, distal;
};

struct PlanarManipulator {
  std::array<LimbBodies, 3> limbs;
  Real platform_mass = 0;
  Real platform_inertia = 0;      ///< about its centre of mass
  Point2<Real> platform_center;   ///< of mass, from P, in platform axes
  Point2<Real> gravity = {0, 0};  ///< acceleration
};

struct PlanarWrench {
  Real x = 0, y = 0, moment = 0;  ///< on the platform, at P
};

/// Direction of the line from one point to another, with its derivatives.
[[nodiscard]] Jet<Real> direction(const Point2<Jet<Real>>& from, const Point2<Jet<Real>>& to);

/// A_i, B_i and C_i of a limb.
/// @param motion  of the platform: x, y of P and its orientation, with their derivatives
/// @throws DerivationError  where the limb cannot reach.
[[nodiscard]] std::array<Point2<Jet<Real>>, 3> limb_joints(const LimbBodies& limb,
                                                           const std::array<Jet<Real>, 3>& motion);

struct ManipulatorForces {
  std::array<Real, 3> torque;               ///< of the base on the proximal links
  std::array<Point2<Real>, 3> on_platform;  ///< of the distal links at C_i
};

/// As `newton_euler_torques`.
[[nodiscard]] ManipulatorForces newton_euler_forces(const PlanarManipulator& manipulator,
                                                    const std::array<Jet<Real>, 3>& motion,
                                                    const PlanarWrench& wrench);

/// Torques of the base on the three proximal links, counterclockwise, in SI.
/// @param motion  as in `limb_joints`
/// @throws DerivationError  where a limb cannot reach, or the posture is singular.
[[nodiscard]] std::array<Real, 3> newton_euler_torques(const PlanarManipulator& manipulator,
                                                       const std::array<Jet<Real>, 3>& motion,
                                                       const PlanarWrench& wrench);

}  // namespace trammel::references
