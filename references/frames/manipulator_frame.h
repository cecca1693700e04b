#pragma once

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// The planar 3-RRR with a rigid platform as a frame, by its own closed-form inverse kinematics:
/// each B_i is where the circles of radius |A_i B_i| about A_i and |B_i C_i| about C_i meet, on the
/// side that the working mode names. Nodes A1-A3, B1-B3, C1-C3, P; members A1-B1 ..., B1-C1 ....
///
/// The format is that of the case files' "manipulator": base_side_m, links (proximal_length_m,
/// distal_length_m, thickness_m, width_m, mass_kg, inertia_kg_m2, beam, shear_coefficient, axial),
/// platform (kind "rigid", side_m, thickness_m, mass_kg, inertia_kg_m2), material, joints (active
/// locked / free / spring, elbow and platform welded / hinged / spring, platform also eq25-mean,
/// eq25-sum), working_mode. One length, one joint of each kind for all limbs.
namespace trammel::references {

/// @throws DerivationError  with the JSON pointer, or where a limb cannot reach.
[[nodiscard]] Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose);

}  // namespace trammel::references
