#include "references/frames/manipulator_frame.h"

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

struct Material {
  Real E, rho, nu;
};

/// A number where one is given; the text "from-density", "from-mass" or nothing otherwise.
bool is_given(const Arguments& object, const std::string& key) {
  return object.has(key) && object[key] != "from-density" && object[key] != "from-mass";
}

FrameSection link_section(const Arguments& links, const Material& material, const Real& length) {
  const Real thickness = links.positive("thickness_m");
  const Real area = thickness * links.positive("width_m");
  const Real second_moment = area * thickness * thickness / 12;
  FrameSection section;
  section.EI = material.E * second_moment;
  if (links.choice("axial", "flexible", {"flexible", "inextensible"}) == "flexible") {
    section.axial_compliance = 1 / (material.E * area);
  }
  section.mass = is_given(links, "mass_kg") ? Real(links.positive("mass_kg") / length)
                                            : Real(material.rho * area);
  if (links.choice("beam", "euler-bernoulli", {"euler-bernoulli", "timoshenko"}) == "timoshenko") {
    const Real G = material.E / (2 * (1 + material.nu));
    section.shear_compliance = 1 / (links.number("shear_coefficient", Real(5) / 6) * G * area);
    section.rotary_inertia = material.rho * second_moment;
  }
  return section;
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

void add_links(const Arguments& links, const Arguments& joints, const Material& material,
               Frame& frame) {
  const Real J = is_given(links, "inertia_kg_m2") ? links.positive("inertia_kg_m2") : Real(0);
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

void add_platform(const Arguments& platform, const Material& material, Frame& frame) {
  const Real side = platform.positive("side_m");
  const Real mass =
      is_given(platform, "mass_kg")
          ? platform.positive("mass_kg")
          : Real(sqrt(Real(3)) / 4 * side * side * platform.positive("thickness_m") * material.rho);
  const Real inertia = is_given(platform, "inertia_kg_m2") ? platform.positive("inertia_kg_m2")
                                                           : Real(mass * side * side / 12);
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
  const Material material{m.positive("E_Pa"), m.positive("rho_kg_m3"), m.number("nu", 0)};
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
