#include "references/frames/manipulator_design.h"

namespace trammel::references {

namespace {

FrameEnd member_end(const Arguments& joints, const std::string& key) {
  const bool constrained = joints[key] == "eq25-mean" || joints[key] == "eq25-sum";
  return read_end(constrained ? Json("hinged") : joints[key], joints, key);
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
        member.ends[0] = member_end(joints, "active");
        if (joints["elbow"] == "hinged") member.ends[1] = member_end(joints, "elbow");
      } else {
        member.ends = {member_end(joints, "elbow"), member_end(joints, "platform")};
      }
      if (link.has_inertia)
        for (FrameEnd& end : member.ends) end.inertia = link.inertia / 2;
      frame.members.push_back(member);
    }
  }
}

}  // namespace

Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose) {
  if (manipulator["platform"].value("kind", "") != "rigid")
    manipulator.fail("platform", "expected a platform of the kind rigid");
  const ManipulatorNumbers numbers = read_manipulator_numbers(manipulator);
  const Arguments joints(manipulator["joints"], manipulator.pointer("joints"),
                         {"active", "elbow", "platform"});
  const Point2<Real> P = {pose.number("x_m"), pose.number("y_m")};
  const Real phi = pose.number("phi_rad", 0), c = cos(phi), s = sin(phi);
  const auto turned = [&](const Point2<Real>& v) -> Point2<Real> {
    return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
  };

  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    const LimbNumbers& limb = numbers.limbs[i];
    const std::string name = std::to_string(i + 1);
    const Point2<Real> corner = turned(limb.corner), C = {P[0] + corner[0], P[1] + corner[1]};
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
      {at, numbers.platform_mass, numbers.platform_inertia, turned(numbers.platform_center)});
  frame.bodies.push_back(
      {at, {frame.find_node("C1"), frame.find_node("C2"), frame.find_node("C3")}});
  add_eq25(joints, frame);
  for (const char* base : {"A1", "A2", "A3"}) {
    frame.supports.push_back({frame.find_node(base), {true, true, true}});
  }
  return frame;
}

}  // namespace trammel::references
