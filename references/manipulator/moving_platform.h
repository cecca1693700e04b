#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Vibration of the platform of a planar 3-RRR about its motion along a path, on links without mass
/// and hinged at both ends of the distal ones: each limb is a bar, elastic along B C,
///   1/k = l_d/EA + l_p cos^2 b/EA + (l_p^3/(3 EI) + l_p/(kappa G A)) sin^2 b,
/// b the angle between the links,
/// and what is left has three coordinates about P, q = (u_x, u_y, theta), in world axes. With the
/// centre of mass at s from P, e the axis of rotation, and W q = u + theta e x s its displacement,
///   m W^T (W q.. + 2 W. q. + W.. q + r..) + J e (theta.. + phi..) + K(t) q = h(t) F,
/// r.. the acceleration of the centre of mass in the nominal motion; the paper leaves W. and W..
/// out (`rate_terms` false). By Fehlberg's method of order 8 in steps of 0.25 ms.
namespace trammel::references {

/// Arguments: manipulator, trajectory, force_N and moment_N_m at P, load_history (time_s, factor:
/// linear between, constant outside), rate_terms, times_s (the first is the start, at rest),
/// output (displacement_x_m | displacement_y_m | platform_rotation_rad | kinetic_energy_J |
/// axial_force_N:B1-C1 ... | torque_N_m:A1 ...). Values: of the output at each time.
[[nodiscard]] std::vector<double> moving_platform_program(const Json& arguments);

}  // namespace trammel::references
