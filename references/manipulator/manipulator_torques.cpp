#include "references/manipulator/manipulator_torques.h"

#include "references/frames/manipulator_design.h"
#include "references/manipulator/newton_euler.h"
#include "references/manipulator/platform_path.h"
#include "references/numerics/roots.h"

namespace trammel::references {

namespace {

LinkBody link_body(const LinkNumbers& link) {
  return {link.mass, link.length / 2, link.inertia};
}

}  // namespace

PlanarManipulator read_planar_manipulator(const Arguments& arguments) {
  const ManipulatorNumbers numbers = read_manipulator_numbers(manipulator_arguments(arguments));
  PlanarManipulator manipulator;
  for (std::size_t i = 0; i < 3; ++i) {
    const LimbNumbers& limb = numbers.limbs[i];
    manipulator.limbs[i] = {limb.base,
                            limb.corner,
                            limb.proximal.length,
                            limb.distal.length,
                            limb.mode,
                            link_body(limb.proximal),
                            link_body(limb.distal)};
  }
  manipulator.platform_mass = numbers.platform_mass;
  manipulator.platform_inertia = numbers.platform_inertia;
  manipulator.platform_center = numbers.platform_center;
  manipulator.gravity = arguments.point_or_origin("gravity_m_s2");
  return manipulator;
}

PlanarWrench read_wrench(const Arguments& arguments) {
  const auto force = arguments.point_or_origin("force_N");
  return {force[0], force[1], arguments.number("moment_N_m", 0)};
}

Arguments read_trajectory(const Arguments& arguments) {
  return arguments.object("trajectory", {"circle", "line", "rest_to_rest", "spline"});
}

std::vector<double> manipulator_torques_program(const Json& json) {
  const Arguments arguments(
      json, "", {"manipulator", "trajectory", "times_s", "force_N", "moment_N_m", "gravity_m_s2"});
  const PlanarManipulator manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory = read_trajectory(arguments);
  const std::vector<Real> times = arguments.numbers("times_s");
  std::vector<Real> values(3 * times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto torques =
        newton_euler_torques(manipulator, platform_motion(trajectory, times[k]), wrench);
    for (std::size_t i = 0; i < 3; ++i) values[i * times.size() + k] = torques[i];
  }
  return to_doubles(values);
}

}  // namespace trammel::references
