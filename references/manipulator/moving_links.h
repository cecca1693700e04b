#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Vibration of a planar 3-RRR with links that have mass and next to no stiffness, each one cubic
/// element of a Timoshenko beam that is hinged at its elbow and at the platform, about its motion
/// along a path. Written in the axes of each link, which turn at W: with the interpolation N of
/// what its nodes do in these axes, x, and Q = diag(rho A, rho A, rho I) along the link,
///   int N^T Q (N x.. + 2 W J N x. + (W. J - W^2 P) N x + r..) ds,
/// J a quarter turn and P the identity of translations; r.. of the nominal motion. Damped by b M,
/// on all of the velocities in world axes. By Fehlberg's method of order 8.
namespace trammel::references {

/// Arguments: manipulator, trajectory, force_N and moment_N_m at P, mass_damping_per_s, times_s
/// (the first is the start, at rest), outputs (displacement_x_m:P, displacement_y_m:B1,
/// platform_rotation_rad, torque_N_m:A1, ...). Values: the first output at all times, then the
/// second.
[[nodiscard]] std::vector<double> moving_links_program(const Json& arguments);

}  // namespace trammel::references
