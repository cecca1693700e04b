#pragma once

#include <vector>

#include "references/manipulator/newton_euler.h"
#include "references/numerics/arguments.h"

/// Programs that derive motions of the planar 3-RRR, and estimates of these motions.
namespace trammel::references {

/// Reads "manipulator", as in a case file, and "gravity_m_s2".
[[nodiscard]] ManipulatorNumbers read_planar_manipulator(const Arguments& arguments);

/// Reads "force_N" and "moment_N_m".
[[nodiscard]] PlanarWrench read_wrench(const Arguments& arguments);

/// Returns "trajectory", for `platform_motion`.
[[nodiscard]] Arguments read_trajectory(const Arguments& arguments);

/// Returns x, y and orientation of the platform with their derivatives at a time. Paths have the
/// format of "trajectory" in case files: circle, line, rest_to_rest or spline. Jet differentiates
/// the positions.
/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] std::array<Jet<Real>, 3> platform_motion(const Arguments& trajectory,
                                                       const Real& time);

/// Arguments: manipulator (as in a case file; masses and inertias are numbers, or from density),
/// trajectory (circle | line | rest_to_rest | spline), times_s.
/// Further arguments: force_N and moment_N_m (on the platform at P; none by default), gravity_m_s2.
/// Values: the torque at A1 at every time, then at A2, then at A3 [N m].
[[nodiscard]] std::vector<Real> manipulator_torques_program(const Arguments& arguments);

/// Arguments: base_m, platform_m (three points [x, y] each), proximal_m, distal_m, angles_rad
/// (three numbers each), output (count | poses). Values: the number, or x, y, phi of each, by phi.
/// @throws DerivationError  if two poses are equal, or if three poses are too close for the proof.
[[nodiscard]] std::vector<Real> assembly_modes_program(const Arguments& arguments);

/// Arguments: as for `manipulator_torques_program`, outputs (names of quantities:
/// active_angle_rad:A1, passive_velocity_rad_per_s:B1, elbow_sine:B1, distal_tension_N:B1-C1,
/// center_acceleration_x_m_per_s2:A1-B1, center_x_m:platform, kinetic_energy_J, kinetic_power_W,
/// actuator_power_W, load_power_W, gravity_power_W, torque_N_m:A1, motion_x_m,
/// parallel_singularity_distance, serial_singularity_distance, cycle_absolute_work_J, ...),
/// at_rest (true: the path is a series of static poses without weight), torque_N_m (constant
/// torques at A1, A2, A3, under which it moves from the start of the path). Values: the first
/// output at all times, then the second.
[[nodiscard]] std::vector<Real> manipulator_motion_program(const Arguments& arguments);

/// Arguments: manipulator, trajectory, force_N and moment_N_m at P, mass_damping_per_s, times_s
/// (the first is the start, at rest), outputs (displacement_x_m:P, displacement_y_m:B1,
/// platform_rotation_rad, torque_N_m:A1, ...). Values: the first output at all times, then the
/// second.
[[nodiscard]] std::vector<Real> moving_links_program(const Arguments& arguments);

/// Arguments: manipulator, trajectory, force_N and moment_N_m at P, load_history (time_s, factor:
/// linear between, constant outside), rate_terms, times_s (the first is the start, at rest),
/// output (displacement_x_m | displacement_y_m | platform_rotation_rad | kinetic_energy_J |
/// axial_force_N:B1-C1 ... | torque_N_m:A1 ...). Values: of the output at each time.
[[nodiscard]] std::vector<Real> moving_platform_program(const Arguments& arguments);

/// Arguments: inputs, outputs, queries (arrays of rows); sigma, or spread in the convention of
/// MATLAB's newgrnn, exp(-(0.8326 D / spread)^2). Values: the outputs at each query.
[[nodiscard]] std::vector<Real> grnn_program(const Arguments& arguments);

/// Arguments: manipulator, trajectory, force_N, moment_N_m, gravity_m_s2 as for torques; step_s,
/// train (points, from the first), sigma [N m], queries (numbers of points), output (angles |
/// velocities). Torques by Newton and Euler train angles and velocities of the active joints.
/// Values: the predictions for A1 at each query, for A2, for A3 [rad or rad/s].
[[nodiscard]] std::vector<Real> manipulator_grnn_program(const Arguments& arguments);

}  // namespace trammel::references
