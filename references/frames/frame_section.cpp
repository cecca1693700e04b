#include "references/frames/frame_section.h"

namespace trammel::references {

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
