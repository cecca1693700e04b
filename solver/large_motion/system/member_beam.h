#pragma once

#include "solver/large_motion/system/beam.h"
#include "solver/large_motion/system/layout.h"

namespace trammel::solver::large_motion {

/// The beam element of a part of a member; zero compliance where the member's theory rules a strain
/// out.
template <int P>
Beam<P> make_beam(const Member& member, const MemberElement& element) {
  const Section& section = element.section;
  const Vector2d span = element.end - element.start;
  Beam<P> beam;
  beam.length = element.length();
  beam.axis = span / beam.length;
  beam.EI = section.EI;
  beam.stretch_compliance = member.axially_flexible ? 1 / section.EA : 0.0;
  beam.mass_per_length = section.mass_per_length;
  beam.lumped = member.mass == MassMatrix::lumped;
  if (has_shear_deformation(member.theory)) beam.shear_compliance = 1 / section.kappa_GA;
  if (has_rotary_inertia(member.theory)) beam.inertia_per_length = section.inertia_per_length;
  return beam;
}

}  // namespace trammel::solver::large_motion
