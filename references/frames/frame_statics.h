#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Exact statics of a frame (`unit_load_statics`) by the names of its outputs.
namespace trammel::references {

/// Arguments: model (or manipulator and pose, with loads), outputs (array of names). Names:
/// displacement_x_m:NODE, displacement_y_m:NODE, rotation_rad:NODE, end_rotation_rad:MEMBER.start,
/// reaction_x_N:NODE, reaction_y_N:NODE, reaction_moment_N_m:NODE, axial_force_N:MEMBER.start,
/// bending_moment_N_m:MEMBER.end. Values: one an output, in the unit that its name ends with.
/// @throws DerivationError  where a name is none of these, or names no part of the frame.
[[nodiscard]] std::vector<double> frame_statics_program(const Json& arguments);

}  // namespace trammel::references
