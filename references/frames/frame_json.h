#pragma once

#include <string>

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Reads a frame in the format of the case files' "model": materials, sections, nodes, members,
/// rigid_bodies, point_masses, springs, supports, loads, gravity_m_s2. Plates and tapered members
/// are not frames in this sense and are refused. A member may carry axial_force_N (tension
/// positive), the state about which it vibrates.
namespace trammel::references {

/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame read_frame(const Json& model, const std::string& pointer);

/// The frame of the arguments: "model" (as a case file's), or "manipulator" with "pose" (x_m, y_m,
/// phi_rad) and "loads".
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame frame_from_arguments(const Arguments& arguments);

}  // namespace trammel::references
