#include "solver/manipulator/restrict_design_effects.h"

namespace trammel::solver {
namespace {

void restrict_effects(LinkDesign& link, Effects active) {
  if (!active.has(Effect::axial_flexibility)) link.axially_flexible = false;
  link.theory = beam_theory(has_shear_deformation(link.theory) && active.has(Effect::shear),
                            has_rotary_inertia(link.theory) && active.has(Effect::rotary_inertia));
  if (active.has(Effect::link_mass)) return;
  link.mass = 0;
  link.inertia.reset();
}

}  // namespace

ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active) {
  for (std::size_t i = 0; i < 3; ++i) {
    restrict_effects(design.proximal[i], active);
    restrict_effects(design.distal[i], active);
    if (active.has(Effect::joint_compliance)) continue;
    if (design.active[i].kind == ActiveKind::sprung) design.active[i] = {ActiveKind::locked};
    if (design.elbow[i].kind == ElbowKind::sprung) design.elbow[i] = {ElbowKind::welded};
    if (design.platform_joint[i].kind == PlatformJointKind::sprung) {
      design.platform_joint[i] = {PlatformJointKind::welded};
    }
  }
  if (!active.has(Effect::platform_flexibility)) {
    design.platform.kind = PlatformDesign::Kind::rigid;
    design.platform.refinements = 0;
    design.platform.six_nodes = false;
    design.platform.pin_radius = 0;
  }
  return design;
}

}  // namespace trammel::solver
