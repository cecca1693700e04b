#pragma once

#include <vector>

#include "references/manipulator/newton_euler.h"
#include "references/numerics/arguments.h"

/// Torques of the planar 3-RRR along a path.
namespace trammel::references {

/// "manipulator", as a case file's, with "gravity_m_s2" beside it.
[[nodiscard]] PlanarManipulator read_planar_manipulator(const Arguments& arguments);

/// "force_N" and "moment_N_m".
[[nodiscard]] PlanarWrench read_wrench(const Arguments& arguments);

/// "trajectory", for `platform_motion`.
[[nodiscard]] Arguments read_trajectory(const Arguments& arguments);

/// Arguments: manipulator (as a case file's; masses and inertias as numbers, or from density),
/// trajectory (circle | line | rest_to_rest | spline), times_s, force_N and moment_N_m (on the
/// platform at P; none by default), gravity_m_s2.
/// Values: the torque at A1 at every time, then at A2, then at A3 [N m].
[[nodiscard]] std::vector<double> manipulator_torques_program(const Json& arguments);

}  // namespace trammel::references
