#include "references/manipulator/programs.h"
#include "references/numerics/real.h"

namespace trammel::references {

ManipulatorNumbers read_planar_manipulator(const Arguments& arguments) {
  ManipulatorNumbers numbers = read_manipulator_numbers(manipulator_arguments(arguments));
  numbers.gravity = arguments.point_or_origin("gravity_m_s2");
  return numbers;
}

PlanarWrench read_wrench(const Arguments& arguments) {
  const auto force = arguments.point_or_origin("force_N");
  return {force[0], force[1], arguments.number("moment_N_m", 0)};
}

Arguments read_trajectory(const Arguments& arguments) {
  return arguments.object("trajectory", {"circle", "line", "rest_to_rest", "spline"});
}

std::vector<Real> manipulator_torques_program(const Arguments& arguments) {
  const ManipulatorNumbers manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory = read_trajectory(arguments);
  const std::vector<Real> times = arguments.numbers("times_s");
  std::vector<Real> values(3 * times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto torques =
        newton_euler_forces(manipulator, platform_motion(trajectory, times[k]), wrench).torque;
    for (std::size_t i = 0; i < 3; ++i) values[i * times.size() + k] = torques[i];
  }
  return values;
}

}  // namespace trammel::references
