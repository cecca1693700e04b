#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Motion of the rigid planar 3-RRR along a path or under constant torques, by name.
namespace trammel::references {

/// Arguments: as for `manipulator_torques_program`, outputs (names as a case's quantities have
/// them: active_angle_rad:A1, passive_velocity_rad_per_s:B1, elbow_sine:B1, distal_tension_N:B1-C1,
/// center_acceleration_x_m_per_s2:A1-B1, center_x_m:platform, kinetic_energy_J, kinetic_power_W,
/// actuator_power_W, load_power_W, gravity_power_W, torque_N_m:A1, motion_x_m,
/// parallel_singularity_distance, serial_singularity_distance, cycle_absolute_work_J, ...),
/// at_rest (true: the path is a row of poses in each of which it stands still, without weight),
/// torque_N_m (constant torques at A1, A2, A3 under which it moves from the path's start on).
/// Values: the first output at all times, then the second.
[[nodiscard]] std::vector<double> manipulator_motion_program(const Json& arguments);

}  // namespace trammel::references
