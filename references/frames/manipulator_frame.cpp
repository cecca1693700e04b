#include "references/frames/manipulator_frame.h"

#include "references/frames/frame_section.h"
#include "references/frames/manipulator_geometry.h"

namespace trammel::references {

namespace {

using Point = Point2<Real>;

struct Limb {
  Point A, B, C;
};

std::array<Limb, 3> limbs(const Arguments& manipulator, const Arguments& links,
                          const Arguments& platform, const Arguments& pose) {
  const Real side = manipulator.positive("base_side_m");
  const auto A = triangle<Real>({side / 2, side / (2 * sqrt(Real(3)))}, side, 0);
  const auto C = triangle<Real>({pose.number("x_m"), pose.number("y_m")},
                                platform.positive("side_m"), pose.number("phi_rad", 0));
  const std::vector<Real> mode = manipulator.has("working_mode")
                                     ? manipulator.numbers("working_mode", 3)
                                     : std::vector<Real>(3, Real(-1));
  std::array<Limb, 3> result;
  for (int i = 0; i < 3; ++i) {
    if (mode[i] != 1 && mode[i] != -1) manipulator.fail("working_mode", "expected 1 or -1");
    result[i] = {A[i],
                 elbow<Real>(A[i], C[i], links.positive("proximal_length_m"),
                             links.positive("distal_length_m"), static_cast<int>(mode[i])),
                 C[i]};
  }
  return result;
}

FrameSection link_section(const Arguments& links, const FrameMaterial& material,
                          const Real& length) {
  CrossSection section =
      rectangle(material, links.positive("thickness_m"), links.positive("width_m"));
  section.shear_coefficient = links.number("shear_coefficient", Real(5) / 6);
  FrameSection result = member_section(section, links);
  if (is_given(links, "mass_kg")) result.mass = links.positive("mass_kg") / length;
  return result;
}

/// welded, hinged or sprung; "locked" and "free" are the words for an active joint.
FrameEnd member_end(const Arguments& joints, const std::string& key) {
  const Json& value = joints[key];
  if (value == "welded" || value == "locked") return {};
  if (value == "hinged" || value == "free" || value == "eq25-mean" || value == "eq25-sum") {
    return {Fixity::hinged, 0, 0};
  }
  if (!value.is_object()) joints.fail(key, "no such joint");
  const Arguments spring(value, joints.pointer(key), {"spring_N_m_per_rad"});
  return {Fixity::sprung, spring.positive("spring_N_m_per_rad"), 0};
}

/// Eq. 25: the platform's rotation is the mean (or the sum, as printed) of the link-end rotations.
void add_eq25(const Arguments& joints, Frame& frame) {
  const Json& platform = joints["platform"];
  if (platform != "eq25-mean" && platform != "eq25-sum") return;
  const Real share = platform == "eq25-mean" ? Real(1) / 3 : Real(1);
  RotationConstraint constraint = {{{frame.find_node("P"), -1, 0}, Real(-1)}};
  for (const char* name : {"B1-C1", "B2-C2", "B3-C3"}) {
    constraint.push_back({{-1, frame.find_member(name), 1}, share});
  }
  frame.constraints.push_back(constraint);
}

void add_links(const Arguments& links, const Arguments& joints, const FrameMaterial& material,
               Frame& frame) {
  const Real J = given_or(links, "inertia_kg_m2", 0);
  for (const char* i : {"1", "2", "3"}) {
    const std::string limb = i;
    for (const bool proximal : {true, false}) {
      FrameMember member;
      const std::string from = (proximal ? "A" : "B") + limb;
      const std::string to = (proximal ? "B" : "C") + limb;
      member.name = from + "-" + to;
      member.nodes = {frame.find_node(from), frame.find_node(to)};
      member.section = link_section(
          links, material, links.positive(proximal ? "proximal_length_m" : "distal_length_m"));
      if (proximal) {
        member.ends[0] = member_end(joints, "active");
        if (joints["elbow"] == "hinged") member.ends[1] = member_end(joints, "elbow");
      } else {
        member.ends = {member_end(joints, "elbow"), member_end(joints, "platform")};
      }
      for (FrameEnd& end : member.ends) end.inertia = J / 2;
      frame.members.push_back(member);
    }
  }
}

void add_platform(const Arguments& platform, const FrameMaterial& material, Frame& frame) {
  const Real side = platform.positive("side_m");
  const Real mass =
      given_or(platform, "mass_kg",
               sqrt(Real(3)) / 4 * side * side * platform.positive("thickness_m") * material.rho);
  const Real inertia = given_or(platform, "inertia_kg_m2", mass * side * side / 12);
  const int P = frame.find_node("P");
  frame.masses.push_back({P, mass, inertia, {}});
  frame.bodies.push_back(
      {P, {frame.find_node("C1"), frame.find_node("C2"), frame.find_node("C3")}});
}

}  // namespace

Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose) {
  const Arguments links(
      manipulator["links"], manipulator.pointer("links"),
      {"proximal_length_m", "distal_length_m", "thickness_m", "width_m", "mass_kg", "inertia_kg_m2",
       "beam", "shear_coefficient", "axial", "mass_matrix", "elements"});
  const Arguments platform(manipulator["platform"], manipulator.pointer("platform"),
                           {"kind", "side_m", "thickness_m", "mass_kg", "inertia_kg_m2"});
  static_cast<void>(platform.choice("kind", "", {"rigid"}));
  const Arguments m(manipulator["material"], manipulator.pointer("material"),
                    {"E_Pa", "rho_kg_m3", "nu"});
  const FrameMaterial material{m.positive("E_Pa"), m.positive("rho_kg_m3"), m.number("nu", 0)};
  const Arguments joints(manipulator["joints"], manipulator.pointer("joints"),
                         {"active", "elbow", "platform"});

  Frame frame;
  const auto positions = limbs(manipulator, links, platform, pose);
  for (int i = 0; i < 3; ++i) {
    const std::string limb = std::to_string(i + 1);
    frame.nodes.push_back({std::string("A").append(limb), positions[i].A});
    frame.nodes.push_back({std::string("B").append(limb), positions[i].B});
    frame.nodes.push_back({std::string("C").append(limb), positions[i].C});
  }
  frame.nodes.push_back({"P", {pose.number("x_m"), pose.number("y_m")}});
  add_links(links, joints, material, frame);
  add_platform(platform, material, frame);
  add_eq25(joints, frame);
  for (const char* base : {"A1", "A2", "A3"}) {
    frame.supports.push_back({frame.find_node(base), {true, true, true}});
  }
  return frame;
}

}  // namespace trammel::references
