#pragma once

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// The planar 3-RRR with a rigid platform as a frame, by its own closed-form inverse kinematics:
/// each B_i is where the circles of radius |A_i B_i| about A_i and |B_i C_i| about C_i meet, on the
/// side that the working mode names. Nodes A1-A3, B1-B3, C1-C3, P; members A1-B1 ..., B1-C1 ....
///
/// The numbers are those of `read_manipulator_numbers`; platform kind "rigid"; joints active locked
/// / free / spring, elbow and platform welded / hinged / spring, platform also eq25-mean, eq25-sum.
namespace trammel::references {

/// @throws DerivationError  with the JSON pointer, or where a limb cannot reach.
[[nodiscard]] Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose);

}  // namespace trammel::references
