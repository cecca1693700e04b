#pragma once

#include <vector>

#include "references/manipulator/newton_euler.h"
#include "references/numerics/arguments.h"

/// Arguments and path of the planar 3-RRR, and its torques along the path.
namespace trammel::references {

/// Reads "manipulator", as in a case file, and "gravity_m_s2".
[[nodiscard]] ManipulatorNumbers read_planar_manipulator(const Arguments& arguments);

/// Reads "force_N" and "moment_N_m".
[[nodiscard]] PlanarWrench read_wrench(const Arguments& arguments);

/// Returns "trajectory", for `platform_motion`.
[[nodiscard]] Arguments read_trajectory(const Arguments& arguments);

/// Returns x, y and orientation of the platform with their derivatives at a time. Paths have the
/// format of the case files' "trajectory": circle, line, rest_to_rest or spline. Only positions are
/// written down, and Jet differentiates them.
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] std::array<Jet<Real>, 3> platform_motion(const Arguments& trajectory,
                                                       const Real& time);

/// Arguments: manipulator (as a case file's; masses and inertias as numbers, or from density),
/// trajectory (circle | line | rest_to_rest | spline), times_s, force_N and moment_N_m (on the
/// platform at P; none by default), gravity_m_s2.
/// Values: the torque at A1 at every time, then at A2, then at A3 [N m].
[[nodiscard]] std::vector<double> manipulator_torques_program(const Json& arguments);

}  // namespace trammel::references
