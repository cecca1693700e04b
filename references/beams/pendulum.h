#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// The plane pendulum of any amplitude by Jacobi's elliptic functions.
namespace trammel::references {

/// Released at rest at the angle a from the lower vertical, counterclockwise positive: with
/// k = sin(a/2) and w = sqrt(g/l), sin(theta/2) = k cd(w t, k), period 4 K(k)/w.
/// Arguments: length_m, gravity_m_s2, start_angle_deg, output (period | position |
/// tension), times_s (for the last two). Values: the period [s], or for each time x and y from the
/// pivot [m], or the force of the rod on 1 kg, g (3 cos theta - 2 cos a) [N].
[[nodiscard]] std::vector<double> pendulum_program(const Json& arguments);

}  // namespace trammel::references
