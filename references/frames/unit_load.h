#pragma once

#include <array>
#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/dense.h"

/// Exact statics of a frame by the unit-load (force) method. The unknowns are the internal forces
/// at the start of each member. Their compliances are integrals of unit-load diagrams:
///
///   phi_ij = integral m_i m_j / EI + n_i n_j / EA + v_i v_j / (kappa GA) dx.
///
/// The complementary energy is minimal among all forces in equilibrium (Castigliano, Engesser). The
/// multipliers of the equations of equilibrium are the displacements. There is no stiffness matrix.
///
/// Along a member, x points from start to end, and w to the left. N is the tension. V = kappa GA
/// (w' - psi) is the force along w on the face toward +x, and M = EI psi'. Therefore V' = -q_w and
/// M' = -V.
namespace trammel::references {

struct MemberForces {
  std::array<Real, 2> N, V, M;  ///< at start and end [N, N, N m]
};

struct FrameStatics {
  RealVector displacement;    ///< displacements u of FrameCoordinates(frame, false)
  RealVector residual_force;  ///< force on each coordinate, reactions excluded
  std::vector<MemberForces> members;
};

/// Computes the exact statics of a frame.
/// @throws DerivationError  if the frame can move freely, or if a rigid part of the frame is
/// statically indeterminate.
[[nodiscard]] FrameStatics force_method_statics(const Frame& frame);

/// Computes outputs of the exact statics of a frame. Names of outputs: displacement_x_m:NODE,
/// displacement_y_m:NODE, rotation_rad:NODE, end_rotation_rad:MEMBER.start, reaction_x_N:NODE,
/// reaction_y_N:NODE, reaction_moment_N_m:NODE, axial_force_N:MEMBER.start,
/// bending_moment_N_m:MEMBER.end. The unit is at the end of the name.
/// @throws DerivationError  if an output is unknown, or if the frame has no such node or member.
[[nodiscard]] std::vector<Real> frame_statics_program(const Arguments& arguments);

}  // namespace trammel::references
