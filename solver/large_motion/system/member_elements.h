#pragma once

#include "solver/large_motion/elements/bar.h"
#include "solver/large_motion/elements/beam.h"
#include "solver/large_motion/system/layout.h"
#include "solver/large_motion/system/system_parts.h"

namespace trammel::solver::large_motion {

/// The beam element of a part of a member; zero compliance where the member's theory rules a strain
/// out.
template <int P>
[[nodiscard]] Beam<P> make_beam(const Member& member, const MemberElement& element) {
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

/// The bar of a member without bending stiffness.
[[nodiscard]] inline Bar make_bar(const Member& member, const MemberElement& element) {
  Bar bar;
  bar.offset = element.end - element.start;
  bar.flexibility = member.axially_flexible ? element.length() / element.section.EA : 0.0;
  bar.total_mass = element.length() * element.section.mass_per_length;
  bar.lumped = member.mass == MassMatrix::lumped;
  return bar;
}

/// The coordinates of an element as an array of fixed size.
template <std::size_t N>
[[nodiscard]] std::array<Index, N> coordinates_of(const MemberElement& element) {
  std::array<Index, N> where{};
  std::copy(element.coordinates.begin(), element.coordinates.end(), where.begin());
  return where;
}

/// Adds the members' beams of that degree and bars, with their masses, distributed loads and
/// inertias at the ends.
void add_members(const Model& model, const Layout& layout, int degree, SystemParts& parts);

}  // namespace trammel::solver::large_motion
