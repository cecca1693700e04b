#include "references/frames/frame.h"

#include <algorithm>

namespace trammel::references {

namespace {

template <class Named>
int find_item_by_name(const std::vector<Named>& items, const std::string& name) {
  const auto found =
      std::ranges::find_if(items, [&](const Named& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

}  // namespace

int Frame::find_node(const std::string& name) const {
  return find_item_by_name(nodes, name);
}

int Frame::find_member(const std::string& name) const {
  return find_item_by_name(members, name);
}

MemberAxis member_axis(const Frame& frame, const FrameMember& member) {
  const auto& a = frame.nodes[member.nodes[0]].position;
  const auto& b = frame.nodes[member.nodes[1]].position;
  const Real dx = b[0] - a[0], dy = b[1] - a[1], length = sqrt(dx * dx + dy * dy);
  if (length == 0) throw DerivationError("member " + member.name + " has no length");
  return {length, dx / length, dy / length};
}

FrameMaterial read_material(const Arguments& where, const std::string& key) {
  const Arguments material = where.object(key, {"E_Pa", "rho_kg_m3", "nu"});
  return {material.positive("E_Pa"), material.not_negative("rho_kg_m3", 0),
          material.number("nu", 0)};
}

FrameSection timoshenko_section(const FrameMaterial& material, const Real& area,
                                const Real& second_moment, const Real& half_depth,
                                const Real& shear_coefficient) {
  const Real G = material.E / (2 * (1 + material.nu));
  FrameSection section;
  section.axial_compliance = 1 / (material.E * area);
  section.EI = material.E * second_moment;
  section.shear_compliance = 1 / (shear_coefficient * G * area);
  section.mass = material.rho * area;
  section.rotary_inertia = material.rho * second_moment;
  section.area = area;
  if (half_depth > 0) section.modulus = second_moment / half_depth;
  return section;
}

FrameSection rectangular_section(const FrameMaterial& material, const Real& thickness,
                                 const Real& width, const Real& shear_coefficient) {
  const Real area = thickness * width;
  return timoshenko_section(material, area, area * thickness * thickness / 12, thickness / 2,
                            shear_coefficient);
}

FrameSection section_for_beam_theory(FrameSection section, const Arguments& member) {
  if (member.choice("axial", "flexible", {"flexible", "inextensible"}) == "inextensible")
    section.axial_compliance = 0;
  const std::string beam = member.choice("beam", "euler-bernoulli",
                                         {"euler-bernoulli", "rayleigh", "shear", "timoshenko"});
  if (beam == "euler-bernoulli" || beam == "rayleigh") section.shear_compliance = 0;
  if (beam == "euler-bernoulli" || beam == "shear") section.rotary_inertia = 0;
  return section;
}

FrameEnd read_end_fixity(const Json& value, const Arguments& where, const std::string& key) {
  if (value == "welded" || value == "locked") return {};
  if (value == "hinged" || value == "free") return {Fixity::hinged, 0, 0};
  if (!value.is_object())
    where.fail(key, R"(expected "welded", "hinged" or {"spring_N_m_per_rad": k})");
  const Arguments spring(value, where.pointer(key), {"spring_N_m_per_rad"});
  return {Fixity::sprung, spring.positive("spring_N_m_per_rad"), 0};
}

}  // namespace trammel::references
