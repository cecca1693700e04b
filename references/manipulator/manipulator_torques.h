#pragma once

#include <vector>

#include "references/manipulator/newton_euler.h"
#include "references/numerics/arguments.h"

/// Torques of the planar 3-RRR along a path.
namespace trammel::references {

/// "manipulator", as a case file's, with "gravity_m_s2" beside it.
[[nodiscard]] ManipulatorNumbers read_planar_manipulator(const Arguments& arguments);

/// "force_N" and "moment_N_m".
[[nodiscard]] PlanarWrench read_wrench(const Arguments& arguments);

/// "trajectory", for `platform_motion`.
[[nodiscard]] Arguments read_trajectory(const Arguments& arguments);

/// Paths of the platform, in the format of the case files' "trajectory": circle, line,
/// rest_to_rest or spline. Only positions are written down; derivatives come by Jet.
/// Returns x, y and orientation of the platform with their derivatives at a time.
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] std::array<Jet<Real>, 3> platform_motion(const Arguments& trajectory,
                                                       const Real& time);

/// Arguments: manipulator (as a case file's; masses and inertias as numbers, or from density),
/// trajectory (circle | line | rest_to_rest | spline), times_s, force_N and moment_N_m (on the
/// platform at P; none by default), gravity_m_s2.
/// Values: the torque at A1 at every time, then at A2, then at A3 [N m].
[[nodiscard]] std::vector<double> manipulator_torques_program(const Json& arguments);

}  // namespace trammel::references
