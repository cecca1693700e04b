#include "solver/assembly/restrict_model_effects.h"

#include <algorithm>

#include "solver/assembly/constraints.h"
#include "solver/elements/frame_element.h"

namespace trammel::solver {
namespace {

bool bends(const Member& member) {
  return section_at(member, 0.5).EI > 0;
}

bool weighs(const Member& member) {
  return member.section.mass_per_length > 0 || member.end_section.mass_per_length > 0;
}

bool has_rotary_inertia_per_length(const Member& member) {
  return member.section.inertia_per_length > 0 || member.end_section.inertia_per_length > 0;
}

bool has_inertia(const Member& member) {
  return weighs(member) || has_rotary_inertia_per_length(member) || member.ends[0].inertia > 0 ||
         member.ends[1].inertia > 0;
}

bool is_sprung(const Member& member) {
  return std::any_of(member.ends.begin(), member.ends.end(),
                     [](const MemberEnd& end) { return end.fixity == EndFixity::sprung; });
}

bool has_weight(const Model& model) {
  if (model.gravity.isZero(0)) return false;
  return std::any_of(model.members.begin(), model.members.end(), weighs) ||
         std::any_of(model.masses.begin(), model.masses.end(),
                     [](const PointMass& point_mass) { return point_mass.mass > 0; }) ||
         std::any_of(model.plates.begin(), model.plates.end(),
                     [](const Plate& plate) { return plate.material.rho > 0; });
}

void take_mass(Section& section) {
  section.mass_per_length = 0;
  section.inertia_per_length = 0;
}

void restrict_effects(Member& member, Effects active) {
  if (!active.has(Effect::axial_flexibility) && bends(member)) member.axially_flexible = false;
  member.theory =
      beam_theory(has_shear_deformation(member.theory) && active.has(Effect::shear),
                  has_rotary_inertia(member.theory) && active.has(Effect::rotary_inertia));
  for (MemberEnd& end : member.ends) {
    const bool stiff = end.fixity == EndFixity::sprung && !active.has(Effect::joint_compliance);
    if (stiff) end = {EndFixity::welded, 0, end.inertia};
    if (!active.has(Effect::link_mass)) end.inertia = 0;
  }
  if (active.has(Effect::link_mass)) return;
  take_mass(member.section);
  take_mass(member.end_section);
}

}  // namespace

Effects applicable_effects(const Model& model) {
  Effects effects;
  for (const Member& member : model.members) {
    if (member.axially_flexible && bends(member)) {
      effects = effects.with(Effect::axial_flexibility);
    }
    if (has_shear_deformation(member.theory) && bends(member))
      effects = effects.with(Effect::shear);
    if (has_rotary_inertia(member.theory) && has_rotary_inertia_per_length(member))
      effects = effects.with(Effect::rotary_inertia);
    if (is_sprung(member)) effects = effects.with(Effect::joint_compliance);
    if (has_inertia(member)) effects = effects.with(Effect::link_mass);
  }
  if (has_weight(model)) effects = effects.with(Effect::gravity);
  return effects;
}

Model restrict_effects(Model model, Effects active) {
  for (Member& member : model.members) restrict_effects(member, active);
  if (!active.has(Effect::gravity)) model.gravity.setZero();
  return model;
}

bool is_axially_overconstrained(const Model& model) {
  Model stiff = restrict_effects(model, Effects::all().without(Effect::axial_flexibility));
  for (Member& member : stiff.members) member.elements = 1;  // what is inside is free to follow
  const Constraints constraints = build_constraints(stiff, discretise(stiff));
  for (std::size_t i = 0; i < constraints.rows.size(); ++i) {
    const bool along = constraints.rows[i].source == ConstraintRow::Source::inextensible;
    if (along && constraints.pivot[i] < 0) return true;
  }
  return false;
}

}  // namespace trammel::solver
