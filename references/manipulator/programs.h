#pragma once

#include <vector>

#include "references/manipulator/newton_euler.h"
#include "references/numerics/arguments.h"

/// Programs that derive motions of the planar 3-RRR manipulator, and estimates of these motions by
/// regression networks. programs.txt lists their arguments. Only arguments that need an explanation
/// are described in this file.
namespace trammel::references {

/// Reads a manipulator from the keys "manipulator", as in a case file, and "gravity_m_s2".
[[nodiscard]] ManipulatorNumbers read_planar_manipulator(const Arguments& arguments);

/// Reads the load on the platform from the keys "force_N" and "moment_N_m".
[[nodiscard]] PlanarWrench read_wrench(const Arguments& arguments);

/// Returns the value of the key "trajectory", which `platform_motion` requires.
[[nodiscard]] Arguments trajectory_arguments(const Arguments& arguments);

/// Returns x, y and orientation of the platform with their derivatives at a time. Paths have the
/// format of "trajectory" in case files: circle, line, rest_to_rest or spline. The positions are
/// differentiated automatically (Jet).
[[nodiscard]] std::array<Jet<Real>, 3> platform_motion(const Arguments& trajectory,
                                                       const Real& time);

/// Computes torques of the actuators along a path by inverse dynamics. Masses and inertias are
/// numbers, or follow from the density. The load force_N, moment_N_m acts on the platform at P.
/// Values: the torque at A1 at every time, then at A2, then at A3 [N m].
[[nodiscard]] std::vector<Real> manipulator_torques_program(const Arguments& arguments);

/// Computes all poses of the platform at given angles of the actuators, or the number of poses.
/// Arguments: base_m, platform_m (three points [x, y] each), proximal_m, distal_m, angles_rad
/// (three numbers each). Values: the number of poses, or x, y, phi of each pose, ascending in phi.
/// @throws DerivationError  if two poses are equal, or if three poses are too close for the proof.
[[nodiscard]] std::vector<Real> assembly_modes_program(const Arguments& arguments);

/// Computes quantities of the motion along a path or under constant torques. Arguments: those of
/// `manipulator_torques_program`, outputs (names of quantities: active_angle_rad:A1,
/// passive_velocity_rad_per_s:B1, elbow_sine:B1, distal_tension_N:B1-C1, center_x_m:platform,
/// kinetic_energy_J, actuator_power_W, torque_N_m:A1, parallel_singularity_distance,
/// cycle_absolute_work_J, ...), at_rest (true: the path is a series of static poses without
/// weight), torque_N_m (constant torques at A1, A2, A3, under which the manipulator moves from the
/// start of the path). Values: the first output at all times, then the second output.
[[nodiscard]] std::vector<Real> manipulator_motion_program(const Arguments& arguments);

/// Computes the vibration of a manipulator with soft links that have mass, about its motion along a
/// path. The load acts at P. The vibration starts at rest at the first of times_s. Outputs:
/// displacement_x_m:P, displacement_y_m:B1, platform_rotation_rad, torque_N_m:A1, ...
/// Values: the first output at all times, then the second output.
[[nodiscard]] std::vector<Real> link_vibration_program(const Arguments& arguments);

/// Computes the vibration of a platform on elastic links without mass, about its motion along a
/// path. The load acts at P. Its factor load_history (time_s, factor) is linear between the times,
/// and constant before the first and after the last time. The vibration starts at rest at the first
/// of times_s. Output: displacement_x_m, displacement_y_m, platform_rotation_rad, kinetic_energy_J,
/// axial_force_N:B1-C1 ... or torque_N_m:A1 .... Values: the requested output at each time.
[[nodiscard]] std::vector<Real> platform_vibration_program(const Arguments& arguments);

/// Computes the estimates of a general regression neural network at each query. Arguments: inputs,
/// outputs, queries (arrays of rows); the smoothing parameter sigma, or spread in the convention of
/// MATLAB's newgrnn, exp(-(0.8326 D / spread)^2), where D is the distance between query and
/// training input.
[[nodiscard]] std::vector<Real> regression_network_program(const Arguments& arguments);

/// Computes the angles or velocities of the active joints that a general regression neural network
/// estimates. The network is trained with torques along the path that follow from the Newton-Euler
/// equations. Point k of the path is at the time k step_s, and k starts from 0. Arguments: train
/// (number of training samples, which are the first points of the path), sigma [N m], queries
/// (numbers k of the points at which the network estimates). Values: the estimates for A1 at each
/// query, then for A2, then for A3 [rad or rad/s].
[[nodiscard]] std::vector<Real> manipulator_grnn_program(const Arguments& arguments);

}  // namespace trammel::references
