#include "references/frames/manipulator_design.h"

namespace trammel::references {

namespace {

/// Returns the vertices of an equilateral triangle, at 210, 330 and 90 degrees about its center.
std::vector<Point2<Real>> triangle(const Point2<Real>& center, const Real& side) {
  const Real height = side / (2 * sqrt(Real(3)));  // distance of the center from each side
  return {{center[0] - side / 2, center[1] - height},
          {center[0] + side / 2, center[1] - height},
          {center[0], center[1] + 2 * height}};
}

/// Returns true if object[key], a mass or inertia, is a number, not "from-density" or "from-mass".
bool is_given_number(const Arguments& object, const std::string& key) {
  return object.has(key) && object[key] != "from-density" && object[key] != "from-mass";
}

/// Returns the mass [kg] or inertia [kg m^2] object[key] if it is a number, otherwise `computed`.
Real given_or_computed(const Arguments& object, const std::string& key, const Real& computed) {
  return is_given_number(object, key) ? object.positive(key) : computed;
}

/// Returns the arguments that describe the proximal or the distal links of a manipulator.
Arguments links_of_kind(const Arguments& manipulator, const char* kind) {
  Json links = manipulator["links"];
  if (links.contains(kind)) links.merge_patch(Json(links[kind]));
  for (const char* difference : {"proximal", "distal"}) links.erase(difference);
  return {links,
          manipulator.pointer("links"),
          {"proximal_length_m", "distal_length_m", "thickness_m", "width_m", "mass_kg",
           "inertia_kg_m2", "beam", "shear_coefficient", "axial", "mass_matrix", "elements"}};
}

LinkNumbers link(const Arguments& links, const FrameMaterial& material, const std::string& length,
                 std::size_t limb) {
  LinkNumbers result;
  result.length =
      links[length].is_array() ? links.numbers(length, 3)[limb] : links.positive(length);
  result.center = result.length / 2;
  result.section = section_for_beam_theory(
      rectangular_section(material, links.positive("thickness_m"), links.positive("width_m"),
                          links.number("shear_coefficient", Real(5) / 6)),
      links);
  result.mass = given_or_computed(links, "mass_kg", result.section.mass * result.length);
  const Real scale = result.mass / (result.section.mass * result.length);
  result.section.mass *= scale;
  result.section.rotary_inertia *= scale;
  result.has_inertia = is_given_number(links, "inertia_kg_m2");
  result.inertia =
      given_or_computed(links, "inertia_kg_m2", result.mass * result.length * result.length / 12);
  return result;
}

void read_platform(const Arguments& manipulator, ManipulatorNumbers& result) {
  const Arguments platform(
      manipulator["platform"], manipulator.pointer("platform"),
      {"kind", "side_m", "vertices_m", "thickness_m", "mass_kg", "inertia_kg_m2", "refinements"});
  const auto corners = platform.has("vertices_m") ? platform.points("vertices_m", 3)
                                                  : triangle({0, 0}, platform.positive("side_m"));
  Point2<Real>& center = result.platform_center;
  for (std::size_t i = 0; i < 3; ++i) {
    result.limbs[i].corner = corners[i];
    for (std::size_t c = 0; c < 2; ++c) center[c] += corners[i][c] / 3;
  }
  Real squares = 0;  // sum of squared distances of the corners from the center
  for (const auto& corner : corners) {
    const Real x = corner[0] - center[0], y = corner[1] - center[1];
    squares += x * x + y * y;
  }
  const Real area = abs((corners[1][0] - corners[0][0]) * (corners[2][1] - corners[0][1]) -
                        (corners[1][1] - corners[0][1]) * (corners[2][0] - corners[0][0])) /
                    2;
  const Real rho =
      read_material(manipulator,
                    manipulator.has("platform_material") ? "platform_material" : "material")
          .rho;
  const Real mass =
      given_or_computed(platform, "mass_kg", area * platform.positive("thickness_m") * rho);
  const Real steiner = mass * (center[0] * center[0] + center[1] * center[1]);
  result.platform_mass = mass;
  result.platform_inertia =
      given_or_computed(platform, "inertia_kg_m2", mass * squares / 12 + steiner) - steiner;
}

FrameEnd member_end_of_joint(const Arguments& joints, const std::string& key) {
  const bool constrained = joints[key] == "eq25-mean" || joints[key] == "eq25-sum";
  return read_end_fixity(constrained ? Json("hinged") : joints[key], joints, key);
}

/// Adds the constraint of Eq. 25 of Varalakshmi and Srinivas (2017): the rotation of the platform
/// is the mean (or, as printed, the sum) of the rotations of the link ends.
void add_constraint_of_eq25(const Arguments& joints, Frame& frame) {
  const Json& platform = joints["platform"];
  if (platform != "eq25-mean" && platform != "eq25-sum") return;
  const Real share = platform == "eq25-mean" ? Real(1) / 3 : Real(1);
  frame.constraints.push_back({frame.find_node("P"), share, {}});
  for (const char* name : {"B1-C1", "B2-C2", "B3-C3"})
    frame.constraints.back().ends.push_back({frame.find_member(name), 1});
}

void add_links(const ManipulatorNumbers& numbers, const Arguments& joints, Frame& frame) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string limb = std::to_string(i + 1);
    for (const bool proximal : {true, false}) {
      const LinkNumbers& link = proximal ? numbers.limbs[i].proximal : numbers.limbs[i].distal;
      FrameMember member;
      const std::string from = (proximal ? "A" : "B") + limb;
      const std::string to = (proximal ? "B" : "C") + limb;
      member.name = from + "-" + to;
      member.nodes = {frame.find_node(from), frame.find_node(to)};
      member.section = link.section;
      if (proximal) {
        member.ends[0] = member_end_of_joint(joints, "active");
        if (joints["elbow"] == "hinged") member.ends[1] = member_end_of_joint(joints, "elbow");
      } else {
        member.ends = {member_end_of_joint(joints, "elbow"),
                       member_end_of_joint(joints, "platform")};
      }
      if (link.has_inertia)
        for (FrameEnd& end : member.ends) end.inertia = link.inertia / 2;
      frame.members.push_back(member);
    }
  }
}

}  // namespace

ManipulatorNumbers read_manipulator_numbers(const Arguments& manipulator) {
  ManipulatorNumbers result;
  read_platform(manipulator, result);
  const FrameMaterial m = read_material(manipulator, "material");
  const Arguments proximal = links_of_kind(manipulator, "proximal");
  const Arguments distal = links_of_kind(manipulator, "distal");
  const Real side = manipulator.positive("base_side_m", 1);  // used if base_m is absent
  const auto base = manipulator.has("base_m")
                        ? manipulator.points("base_m", 3)
                        : triangle({side / 2, side / (2 * sqrt(Real(3)))}, side);
  for (std::size_t i = 0; i < 3; ++i) {
    LimbNumbers& limb = result.limbs[i];
    limb.base = base[i];
    limb.proximal = link(proximal, m, "proximal_length_m", i);
    limb.distal = link(distal, m, "distal_length_m", i);
    if (!manipulator.has("working_mode")) continue;
    const Real mode = manipulator.numbers("working_mode", 3)[i];
    if (mode != 1 && mode != -1) manipulator.fail("working_mode", "expected 1 or -1");
    limb.mode = mode > 0 ? 1 : -1;
  }
  return result;
}

Arguments manipulator_arguments(const Arguments& arguments) {
  return {arguments["manipulator"],
          "/manipulator",
          {"base_side_m", "base_m", "links", "platform", "material", "platform_material", "joints",
           "working_mode"}};
}

Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose) {
  if (manipulator["platform"].value("kind", "") != "rigid")
    manipulator.fail("platform", "expected the platform kind 'rigid'");
  const ManipulatorNumbers numbers = read_manipulator_numbers(manipulator);
  const Arguments joints(manipulator["joints"], manipulator.pointer("joints"),
                         {"active", "elbow", "platform"});
  const Point2<Real> P = {pose.number("x_m"), pose.number("y_m")};
  const Real phi = pose.number("phi_rad", 0);

  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    const LimbNumbers& limb = numbers.limbs[i];
    const std::string name = std::to_string(i + 1);
    const Point2<Real> corner = rotated(limb.corner, phi), C = {P[0] + corner[0], P[1] + corner[1]};
    frame.nodes.push_back({std::string("A").append(name), limb.base});
    frame.nodes.push_back(
        {std::string("B").append(name),
         elbow<Real>(limb.base, C, limb.proximal.length, limb.distal.length, limb.mode)});
    frame.nodes.push_back({std::string("C").append(name), C});
  }
  frame.nodes.push_back({"P", P});
  add_links(numbers, joints, frame);
  const int at = frame.find_node("P");
  frame.masses.push_back(
      {at, numbers.platform_mass, numbers.platform_inertia, rotated(numbers.platform_center, phi)});
  frame.bodies.push_back(
      {at, {frame.find_node("C1"), frame.find_node("C2"), frame.find_node("C3")}});
  add_constraint_of_eq25(joints, frame);
  for (const char* base : {"A1", "A2", "A3"})
    frame.supports.push_back({frame.find_node(base), {true, true, true}});
  return frame;
}

}  // namespace trammel::references
