#include "harness/readers/discretization.h"
#include "harness/readers/field_reader.h"
#include "harness/readers/model_reader.h"

namespace trammel::harness {
namespace {

/// Requires exactly one of two alternative keys.
/// @returns true if the first key is present
bool require_one_of_two_keys(const JsonView& place, const char* first, const char* second) {
  if (place.has(first) == place.has(second))
    throw place.error(std::string("expected either '") + first + "' or '" + second + "' (got " +
                      (place.has(first) ? "both; the value null removes a key)" : "none)"));
  return place.has(first);
}

solver::ManipulatorGeometry read_geometry(const JsonView& manipulator) {
  const JsonView platform = manipulator["platform"];
  const FieldReader reader(manipulator), links(manipulator["links"]);
  solver::ManipulatorGeometry geometry;
  if (require_one_of_two_keys(manipulator, "base_side_m", "base_m"))
    geometry.base = solver::equilateral_base(manipulator.number("base_side_m"));
  reader.optional("base_m", geometry.base);
  if (require_one_of_two_keys(platform, "side_m", "vertices_m"))
    geometry.platform = solver::equilateral_platform(platform.number("side_m"));
  FieldReader(platform).optional("vertices_m", geometry.platform);
  links.required("proximal_length_m", geometry.proximal);
  links.required("distal_length_m", geometry.distal);
  reader.optional("working_mode", geometry.working_mode);
  return geometry;
}

/// Adds the properties in a JSON object to those of a link. The object applies to all links, or
/// only to the proximal or distal links.
void read_link(const JsonView& place, solver::LinkDesign& link) {
  const FieldReader reader(place);
  reader.optional("thickness_m", link.thickness);
  reader.optional("width_m", link.width);
  reader.optional("shear_coefficient", link.shear_coefficient);
  reader.optional("beam", link.theory);
  reader.optional("mass_matrix", link.mass_matrix);
  reader.optional("elements", link.elements);
  Axial axial = link.axially_flexible ? Axial::flexible : Axial::inextensible;
  reader.optional("axial", axial);
  link.axially_flexible = axial == Axial::flexible;
  reader.optional("mass_kg", link.mass);
  reader.optional("inertia_kg_m2", link.inertia);
}

solver::PlatformDesign read_platform(const JsonView& place) {
  const FieldReader reader(place);
  solver::PlatformDesign design;
  reader.required("kind", design.kind);
  reader.required("thickness_m", design.thickness);
  reader.optional("refinements", design.refinements);
  design.six_nodes = place.get<std::string>("element", "") == "six-node";
  reader.optional("pin_radius_m", design.pin_radius);
  reader.optional("mass_kg", design.mass);
  reader.optional("inertia_kg_m2", design.inertia);
  return design;
}

solver::Pose read_pose(const JsonView& pose) {
  return {pose.number("x_m"), pose.number("y_m"), pose.number("phi_rad")};
}

solver::Circle read_circle(const JsonView& place) {
  const FieldReader reader(place);
  solver::Circle circle;
  reader.required("center_m", circle.center);
  reader.required("radius_m", circle.radius);
  reader.optional("angular_speed_rad_s", circle.angular_speed);
  reader.optional("phi_rad", circle.phi);
  return circle;
}

solver::Spline read_spline(const JsonView& spline) {
  std::vector<double> times;
  std::vector<solver::Pose> poses;
  for (const auto& [index, knot] : spline.entries("knots")) {
    times.push_back(knot.number("time_s"));
    poses.push_back(read_pose(knot));
  }
  if (times.front() != 0)
    throw spline["knots"][0].error("expected the first knot at 0 s (got " +
                                   shortest_decimal(times.front()) + " s)");
  return solver::make_spline(times, poses, spline.get("ends", solver::SplineEnds::natural));
}

solver::Path read_path(const std::string& kind, const JsonView& place) {
  if (kind == "circle") return read_circle(place);
  if (kind == "spline") return read_spline(place);
  const solver::Pose from = read_pose(place["from"]), to = read_pose(place["to"]);
  const double duration = place.number("duration_s");
  if (kind == "line") return solver::Line{from, to, duration};
  return solver::RestToRest{from, to, duration};
}

/// Reads a path and computes its points at the times 0, step, 2 step, ...
PlatformMotion read_trajectory(const JsonView& trajectory) {
  const auto [kind, place] = trajectory.entries().front();
  try {
    const solver::Path path = read_path(kind, place);
    return {path,
            solver::sample(path, place["points"].get<solver::Index>(), place.number("step_s"))};
  } catch (const solver::ModelError& error) {
    throw place.error(std::string("expected a valid trajectory: ") + error.what());
  }
}

}  // namespace

solver::ManipulatorDesign read_manipulator(const JsonView& manipulator) {
  solver::ManipulatorDesign design;
  design.geometry = read_geometry(manipulator);
  try {
    solver::check_geometry(design.geometry);
  } catch (const solver::ModelError& error) {
    throw manipulator.error(std::string("expected a valid geometry: ") + error.what());
  }
  const JsonView links = manipulator["links"];
  solver::LinkDesign link;
  link.material = read_material(manipulator["material"]);
  link.elements = default_element_count(manipulator.document());
  read_link(links, link);
  design.proximal.fill(link);
  design.distal.fill(link);
  if (links.has("proximal"))
    for (solver::LinkDesign& each : design.proximal) read_link(links["proximal"], each);
  if (links.has("distal"))
    for (solver::LinkDesign& each : design.distal) read_link(links["distal"], each);
  design.platform = read_platform(manipulator["platform"]);
  const bool own = manipulator.has("platform_material");
  design.platform.material = own ? read_material(manipulator["platform_material"]) : link.material;
  const FieldReader joints(manipulator["joints"]);
  joints.required("active", design.active);
  joints.required("elbow", design.elbow);
  joints.required("platform", design.platform_joint);
  return design;
}

PlatformMotion read_platform_motion(const JsonView& model,
                                    const solver::ManipulatorGeometry& geometry) {
  PlatformMotion motion;
  const bool single = require_one_of_two_keys(model, "pose", "trajectory");
  if (single) {
    motion.points = {{0, read_pose(model["pose"])}};
  } else {
    motion = read_trajectory(model["trajectory"]);
  }
  for (std::size_t i = 0; i < motion.points.size(); ++i) {
    std::string reason;
    try {
      const auto posture = solver::inverse_kinematics(geometry, motion.points[i].pose);
      if (posture.outcome.solved()) continue;
      reason = posture.outcome.reason;
    } catch (const solver::ModelError& error) {  // overflow between knots of a spline
      reason = error.what();
    }
    const std::string point = single ? "" : " at point " + std::to_string(i);
    throw model[single ? "pose" : "trajectory"].error("expected a pose within reach" + point +
                                                      " (" + reason + ")");
  }
  return motion;
}

}  // namespace trammel::harness
