#pragma once

#include <string>
#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Programs that derive exact statics and dynamics of frames.
namespace trammel::references {

/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame read_frame(const Json& model, const std::string& pointer);

/// The frame of the arguments: "model" (as a case file's), or "manipulator" with "pose" (x_m, y_m,
/// phi_rad) and "loads".
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame frame_from_arguments(const Arguments& arguments);

/// Central differences of `frame_frequencies`, each good to 1e-20, at step, step / 2 and step / 4,
/// extrapolated twice: the error is O(step^6) plus 1e-20 over the step. Frequencies that remain
/// repeated have a common derivative. Arguments: model (or manipulator and pose), pointers (JSON
/// pointers into the arguments, to equal numbers that change together), step (in their unit),
/// count. Values: [Hz / unit], ascending in frequency.
[[nodiscard]] std::vector<Real> frame_sensitivity_program(const Arguments& arguments);

/// Arguments: model (or manipulator and pose, with loads), outputs (array of names). Names:
/// displacement_x_m:NODE, displacement_y_m:NODE, rotation_rad:NODE, end_rotation_rad:MEMBER.start,
/// reaction_x_N:NODE, reaction_y_N:NODE, reaction_moment_N_m:NODE, axial_force_N:MEMBER.start,
/// bending_moment_N_m:MEMBER.end. Values: one an output, in the unit that its name ends with.
/// @throws DerivationError  if a name is none of these, or names no part of the frame.
[[nodiscard]] std::vector<Real> frame_statics_program(const Arguments& arguments);

/// Computes the first `count` positive factors of the loads at which the frame buckles: the axial
/// forces of unit_load_statics times the factor, and the count at vanishing frequency.
/// Arguments: model (or manipulator, pose and loads), count. Values: factors of the loads.
/// @throws DerivationError  if an axial force varies along its member.
[[nodiscard]] std::vector<Real> frame_buckling_program(const Arguments& arguments);

}  // namespace trammel::references
