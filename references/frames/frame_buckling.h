#pragma once

#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Critical loads of a frame by the Wittrick-Williams count.
namespace trammel::references {

/// The first `count` positive factors of the loads at which the frame buckles: the axial forces of
/// unit_load_statics times the factor, and the count at vanishing frequency.
/// @throws DerivationError  where an axial force varies along its member.
[[nodiscard]] std::vector<Real> frame_buckling_factors(const Frame& frame, int count);

/// Arguments: model (or manipulator, pose and loads), count. Values: factors of the loads.
[[nodiscard]] std::vector<double> frame_buckling_program(const Json& arguments);

}  // namespace trammel::references
