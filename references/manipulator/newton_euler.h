#pragma once

#include <array>

#include "references/frames/manipulator_design.h"
#include "references/numerics/jet.h"

/// Inverse dynamics of the planar 3-RRR manipulator by the laws of Newton and Euler for each of its
/// seven
/// bodies: 21 equations for the forces in the nine joints and the three torques. The class Jet
/// differentiates the motions. The derivation uses no Lagrangian, no Jacobian and no mass matrix.
namespace trammel::references {

struct PlanarWrench {
  Real x = 0, y = 0, moment = 0;  ///< load on the platform at P [N, N m]
};

using PointJet = Point2<Jet<Real>>;

/// Return the center of mass of a link with the joints `from` and `to`, or of the platform.
[[nodiscard]] PointJet mass_center(const LinkNumbers& link, const PointJet& from,
                                   const PointJet& to);
[[nodiscard]] PointJet platform_mass_center(const ManipulatorNumbers& manipulator,
                                            const std::array<Jet<Real>, 3>& motion);

/// Returns the angle of the line from one point to another, with its time derivatives.
[[nodiscard]] Jet<Real> direction_angle(const PointJet& from, const PointJet& to);

/// Returns the joints A_i, B_i and C_i of a limb.
/// @param motion  x, y of P and orientation of the platform, with their time derivatives
/// @throws DerivationError  if the limb cannot reach its platform joint.
[[nodiscard]] std::array<PointJet, 3> limb_joints(const LimbNumbers& limb,
                                                  const std::array<Jet<Real>, 3>& motion);

struct ManipulatorForces {
  std::array<Real, 3> torque;               ///< torques of the base on the proximal links
  std::array<Point2<Real>, 3> on_platform;  ///< forces of the distal links at C_i
};

/// Computes the forces between platform and limbs, and the torques of the base on the three
/// proximal links, counterclockwise [N, N m].
/// @param motion  as in `limb_joints`
/// @throws DerivationError  if a limb cannot reach its platform joint, or if the pose is singular.
[[nodiscard]] ManipulatorForces newton_euler_forces(const ManipulatorNumbers& manipulator,
                                                    const std::array<Jet<Real>, 3>& motion,
                                                    const PlanarWrench& wrench);

}  // namespace trammel::references
