#include "references/manipulator/manipulator_torques.h"

#include "references/manipulator/newton_euler.h"
#include "references/manipulator/platform_path.h"
#include "references/numerics/roots.h"

namespace trammel::references {

namespace {

LinkBody link_body(const Arguments& links, const Real& density, const Real& length) {
  const Real volume = length * links.positive("thickness_m") * links.positive("width_m");
  LinkBody body;
  body.mass = given_or(links, "mass_kg", density * volume);
  body.center = length / 2;
  body.inertia = given_or(links, "inertia_kg_m2", body.mass * length * length / 12);
  return body;
}

PlanarManipulator read_manipulator(const Arguments& manipulator) {
  const Arguments links(manipulator["links"], manipulator.pointer("links"),
                        {"proximal_length_m", "distal_length_m", "thickness_m", "width_m",
                         "mass_kg", "inertia_kg_m2"});
  const Arguments platform(manipulator["platform"], manipulator.pointer("platform"),
                           {"kind", "side_m", "thickness_m", "mass_kg", "inertia_kg_m2"});
  const Arguments material(manipulator["material"], manipulator.pointer("material"),
                           {"E_Pa", "rho_kg_m3", "nu"});
  const Real density = material.positive("rho_kg_m3");
  const Real base = manipulator.positive("base_side_m");
  const Real side = platform.positive("side_m");
  const auto base_joints = triangle<Real>({base / 2, base / (2 * sqrt(Real(3)))}, base, 0);
  const auto corners = triangle<Real>({0, 0}, side, 0);
  PlanarManipulator result;
  for (std::size_t i = 0; i < 3; ++i) {
    LimbBodies& limb = result.limbs[i];
    limb.base = base_joints[i];
    limb.corner = corners[i];
    limb.proximal_length = links.positive("proximal_length_m");
    limb.distal_length = links.positive("distal_length_m");
    limb.proximal = link_body(links, density, limb.proximal_length);
    limb.distal = link_body(links, density, limb.distal_length);
    if (!manipulator.has("working_mode")) continue;
    limb.mode = manipulator.numbers("working_mode", 3)[i] > 0 ? 1 : -1;
  }
  result.platform_center = {0, 0};
  result.platform_mass =
      given_or(platform, "mass_kg",
               sqrt(Real(3)) / 4 * side * side * platform.positive("thickness_m") * density);
  result.platform_inertia =
      given_or(platform, "inertia_kg_m2", result.platform_mass * side * side / 12);
  return result;
}

}  // namespace

PlanarManipulator read_planar_manipulator(const Arguments& arguments) {
  PlanarManipulator manipulator =
      read_manipulator(Arguments(arguments["manipulator"], "/manipulator",
                                 {"base_side_m", "links", "platform", "material", "working_mode"}));
  if (arguments.has("gravity_m_s2")) {
    const std::vector<Real> g = arguments.numbers("gravity_m_s2", 2);
    manipulator.gravity = {g[0], g[1]};
  }
  return manipulator;
}

PlanarWrench read_wrench(const Arguments& arguments) {
  PlanarWrench wrench;
  if (arguments.has("force_N")) {
    const std::vector<Real> force = arguments.numbers("force_N", 2);
    wrench.x = force[0];
    wrench.y = force[1];
  }
  wrench.moment = arguments.number("moment_N_m", 0);
  return wrench;
}

std::vector<double> manipulator_torques_program(const Json& json) {
  const Arguments arguments(
      json, "", {"manipulator", "trajectory", "times_s", "force_N", "moment_N_m", "gravity_m_s2"});
  const PlanarManipulator manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory(arguments["trajectory"], "/trajectory",
                             {"circle", "line", "rest_to_rest", "spline"});
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
