#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// All poses of a planar 3-RRR at given angles of its actuators, and the proof that there are no
/// more (J.-P. Merlet, Parallel Robots, 2nd ed., 2006, section 4.3). With the elbows B_i, the
/// platform's joints c_i and D_i = B_i - R(phi) c_i, the platform lies on three circles about D_i;
/// without their common unknowns a trigonometric polynomial Q(phi) of degree 3 is left, at most six
/// zeros. By Bernstein the k-th derivative is at most 3^k max|Q|: intervals are halved until each
/// is shown to have none, one or, on either side of an extremum, two.
namespace trammel::references {

/// Arguments: base_m, platform_m (three points [x, y] each), proximal_m, distal_m, angles_rad
/// (three numbers each), output (count | poses). Values: the number, or x, y, phi of each, by phi.
/// @throws DerivationError  where two poses are the same, or three too near to each other for the
/// proof.
[[nodiscard]] std::vector<double> assembly_modes_program(const Json& arguments);

}  // namespace trammel::references
