#pragma once

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// What the derivations of frames share: where the frame comes from.
namespace trammel::references {

/// The frame of the arguments: "model", or "manipulator" with "pose" (and "loads").
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] Frame frame_from_arguments(const Arguments& arguments);

}  // namespace trammel::references
