#include "references/frames/frame.h"

#include <algorithm>

namespace trammel::references {

namespace {

template <class Named>
int find_name(const std::vector<Named>& items, const std::string& name) {
  const auto found =
      std::ranges::find_if(items, [&](const Named& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

}  // namespace

int Frame::find_node(const std::string& name) const {
  return find_name(nodes, name);
}

int Frame::find_member(const std::string& name) const {
  return find_name(members, name);
}

MemberAxis member_axis(const Frame& frame, const FrameMember& member) {
  const auto& a = frame.nodes[member.nodes[0]].position;
  const auto& b = frame.nodes[member.nodes[1]].position;
  const Real dx = b[0] - a[0];
  const Real dy = b[1] - a[1];
  const Real length = sqrt(dx * dx + dy * dy);
  if (length == 0) throw DerivationError("member " + member.name + " has no length");
  return {length, dx / length, dy / length};
}

CrossSection rectangle(const FrameMaterial& material, const Real& thickness, const Real& width) {
  CrossSection section;
  section.material = material;
  section.area = thickness * width;
  section.second_moment = section.area * thickness * thickness / 12;
  section.half_depth = thickness / 2;
  return section;
}

FrameSection member_section(const CrossSection& data, const Arguments& member) {
  const FrameMaterial& m = data.material;
  FrameSection section;
  if (member.choice("axial", "flexible", {"flexible", "inextensible"}) == "flexible") {
    section.axial_compliance = 1 / (m.E * data.area);
  }
  section.EI = m.E * data.second_moment;
  section.mass = m.rho * data.area;
  section.area = data.area;
  if (data.half_depth > 0) section.modulus = data.second_moment / data.half_depth;
  const std::string beam = member.choice("beam", "euler-bernoulli",
                                         {"euler-bernoulli", "rayleigh", "shear", "timoshenko"});
  if (beam == "shear" || beam == "timoshenko") {
    const Real G = m.E / (2 * (1 + m.nu));
    section.shear_compliance = 1 / (data.shear_coefficient * G * data.area);
  }
  if (beam == "rayleigh" || beam == "timoshenko")
    section.rotary_inertia = m.rho * data.second_moment;
  return section;
}

}  // namespace trammel::references
