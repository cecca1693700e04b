#pragma once

#include <array>

#include "references/numerics/arguments.h"
#include "references/numerics/jet.h"

/// Paths of the platform, in the format of the case files' "trajectory": circle, line,
/// rest_to_rest or spline. Only positions are written down; derivatives come by Jet.
namespace trammel::references {

/// x, y and orientation of the platform with their derivatives at a time.
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] std::array<Jet<Real>, 3> platform_motion(const Arguments& trajectory,
                                                       const Real& time);

}  // namespace trammel::references
