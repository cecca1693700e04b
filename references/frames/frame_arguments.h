#pragma once

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Where the frame of a derivation comes from.
namespace trammel::references {

/// The frame of the arguments: "model" (as a case file's), or "manipulator" with "pose" (x_m, y_m,
/// phi_rad) and "loads".
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame frame_from_arguments(const Arguments& arguments);

}  // namespace trammel::references
