#include "harness/readers/manipulator_reader.h"

#include <map>

#include "harness/readers/material_reader.h"
#include "harness/readers/trajectory_reader.h"

namespace trammel::harness {
namespace {

std::array<Eigen::Vector2d, 3> read_vertices(const JsonView& vertices) {
  return {read_point(vertices[0]), read_point(vertices[1]), read_point(vertices[2])};
}

std::array<double, 3> read_lengths(const JsonView& lengths) {
  if (lengths.json().is_number()) {
    const double length = lengths.get<double>();
    return {length, length, length};
  }
  return {lengths[0].get<double>(), lengths[1].get<double>(), lengths[2].get<double>()};
}

/// Exactly one of two keys that say the same in two ways.
bool has_first(const JsonView& place, const char* first, const char* second) {
  if (place.has(first) == place.has(second)) {
    throw place.error(std::string("expected either '") + first + "' or '" + second + "' (got " +
                      (place.has(first) ? "both; null removes one)" : "none)"));
  }
  return place.has(first);
}

solver::ManipulatorGeometry read_geometry(const JsonView& manipulator) {
  const JsonView links = manipulator["links"];
  const JsonView platform = manipulator["platform"];
  solver::ManipulatorGeometry geometry;
  geometry.base = has_first(manipulator, "base_side_m", "base_m")
                      ? solver::equilateral_base(manipulator.number("base_side_m"))
                      : read_vertices(manipulator["base_m"]);
  geometry.platform = has_first(platform, "side_m", "vertices_m")
                          ? solver::equilateral_platform(platform.number("side_m"))
                          : read_vertices(platform["vertices_m"]);
  geometry.proximal = read_lengths(links["proximal_length_m"]);
  geometry.distal = read_lengths(links["distal_length_m"]);
  geometry.working_mode = manipulator.get("working_mode", std::array<int, 3>{-1, -1, -1});
  return geometry;
}

/// A number, or a word that stands for "as computed".
std::optional<double> read_printed(const JsonView& part, const char* key) {
  const auto value = part.find(key);
  if (!value || value->json().is_string()) return std::nullopt;
  return value->get<double>();
}

solver::LinkDesign read_link(const JsonView& links, const char* which,
                             const solver::Material& material) {
  const auto difference = links.find(which);
  const auto at = [&](const char* key) -> const JsonView& {
    return difference && difference->has(key) ? *difference : links;
  };
  solver::LinkDesign link;
  link.thickness = at("thickness_m").number("thickness_m");
  link.width = at("width_m").number("width_m");
  link.material = material;
  link.shear_coefficient = at("shear_coefficient").get("shear_coefficient", 5.0 / 6.0);
  link.theory = read_beam_theory(at("beam"));
  link.mass_matrix = read_mass_matrix(at("mass_matrix"));
  link.elements = at("elements").get<solver::Index>("elements", 1);
  link.axially_flexible = read_axial(at("axial"));
  link.mass = read_printed(at("mass_kg"), "mass_kg");
  link.inertia = read_printed(at("inertia_kg_m2"), "inertia_kg_m2");
  return link;
}

solver::PlatformDesign read_platform(const JsonView& manipulator) {
  const JsonView platform = manipulator["platform"];
  solver::PlatformDesign design;
  design.kind = platform.text("kind") == "rigid" ? solver::PlatformDesign::Kind::rigid
                                                 : solver::PlatformDesign::Kind::triangles;
  design.thickness = platform.number("thickness_m");
  design.material = read_material(
      manipulator[manipulator.has("platform_material") ? "platform_material" : "material"]);
  design.refinements = platform.get("refinements", 0);
  design.six_nodes = platform.get<std::string>("element", "three-node") == "six-node";
  design.pin_radius = platform.get("pin_radius_m", 0.0);
  design.mass = read_printed(platform, "mass_kg");
  design.inertia = read_printed(platform, "inertia_kg_m2");
  return design;
}

template <class Kind>
std::array<solver::Joint<Kind>, 3> read_joints(const JsonView& joints, const char* key,
                                               const std::map<std::string, Kind>& kinds) {
  const JsonView choice = joints[key];
  std::array<solver::Joint<Kind>, 3> read;
  for (std::size_t i = 0; i < 3; ++i) {
    const JsonView item = choice.json().is_array() ? choice[i] : choice;
    if (item.json().is_object()) {
      read[i] = {Kind::sprung, item.number("spring_N_m_per_rad")};
    } else {
      read[i] = {kinds.at(item.get<std::string>()), 0};
    }
  }
  return read;
}

}  // namespace

solver::ManipulatorDesign read_manipulator(const JsonView& manipulator) {
  solver::ManipulatorDesign design;
  design.geometry = read_geometry(manipulator);
  try {
    solver::check_geometry(design.geometry);
  } catch (const solver::ModelError& error) {
    throw manipulator.error(std::string("expected a geometry that has a meaning: ") + error.what());
  }
  const solver::Material material = read_material(manipulator["material"]);
  design.proximal.fill(read_link(manipulator["links"], "proximal", material));
  design.distal.fill(read_link(manipulator["links"], "distal", material));
  design.platform = read_platform(manipulator);
  const JsonView joints = manipulator["joints"];
  design.active = read_joints<solver::ActiveKind>(
      joints, "active",
      {{"locked", solver::ActiveKind::locked}, {"free", solver::ActiveKind::free}});
  design.elbow = read_joints<solver::ElbowKind>(
      joints, "elbow",
      {{"welded", solver::ElbowKind::welded}, {"hinged", solver::ElbowKind::hinged}});
  design.platform_joint =
      read_joints<solver::PlatformJointKind>(joints, "platform",
                                             {{"hinged", solver::PlatformJointKind::hinged},
                                              {"welded", solver::PlatformJointKind::welded},
                                              {"eq25-mean", solver::PlatformJointKind::eq25_mean},
                                              {"eq25-sum", solver::PlatformJointKind::eq25_sum}});
  return design;
}

PlatformMotion read_platform_motion(const JsonView& model,
                                    const solver::ManipulatorGeometry& geometry) {
  PlatformMotion motion;
  const bool single = has_first(model, "pose", "trajectory");
  if (single) {
    const JsonView pose = model["pose"];
    motion.points = {{0, {pose.number("x_m"), pose.number("y_m"), pose.number("phi_rad")}}};
  } else {
    Trajectory trajectory = read_trajectory(model["trajectory"]);
    motion = {std::move(trajectory.path), std::move(trajectory.motion)};
  }
  for (std::size_t i = 0; i < motion.points.size(); ++i) {
    std::string reason;
    try {
      const auto posture = solver::inverse_kinematics(geometry, motion.points[i].pose);
      if (posture.outcome.solved()) continue;
      reason = posture.outcome.reason;
    } catch (const solver::ModelError& error) {  // a path may overflow between finite knots
      reason = error.what();
    }
    const std::string point = single ? "" : " at point " + std::to_string(i);
    throw model[single ? "pose" : "trajectory"].error("expected a pose within reach" + point +
                                                      " (" + reason + ")");
  }
  return motion;
}

}  // namespace trammel::harness
