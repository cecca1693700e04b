#include "solver/manipulator/reduced_design.h"

namespace trammel {
namespace {

void reduce(LinkDesign& link, Effects kept) {
  if (!kept.has(Effect::axial_flexibility)) link.axially_flexible = false;
  link.theory = beam_theory(shears(link.theory) && kept.has(Effect::shear),
                            has_rotary_inertia(link.theory) && kept.has(Effect::rotary_inertia));
  if (kept.has(Effect::link_mass)) return;
  link.mass = 0;
  link.inertia.reset();
}

}  // namespace

ManipulatorDesign reduced(ManipulatorDesign design, Effects kept) {
  for (std::size_t i = 0; i < 3; ++i) {
    reduce(design.proximal[i], kept);
    reduce(design.distal[i], kept);
    if (kept.has(Effect::joint_compliance)) continue;
    if (design.active[i].kind == ActiveKind::sprung) design.active[i] = {ActiveKind::locked};
    if (design.elbow[i].kind == ElbowKind::sprung) design.elbow[i] = {ElbowKind::welded};
    if (design.platform_joint[i].kind == PlatformJointKind::sprung) {
      design.platform_joint[i] = {PlatformJointKind::welded};
    }
  }
  if (!kept.has(Effect::platform_flexibility)) {
    design.platform.kind = PlatformDesign::Kind::rigid;
    design.platform.refinements = 0;
    design.platform.pin_radius = 0;
  }
  return design;
}

}  // namespace trammel
