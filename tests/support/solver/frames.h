#pragma once

#include <cmath>
#include <string>

#include "solver/elements/block_mesh.h"
#include "solver/model/model.h"

/// Small frames that the tests of the solver share.
namespace trammel::testing {

using namespace solver;

/// Returns a rectangular section with the size `depth` x `width`. The depth is in the plane of the
/// frame.
inline Section rectangle(const Material& material, double depth, double width,
                         double shear_coefficient = 5.0 / 6.0) {
  const double A = depth * width, I = width * depth * depth * depth / 12;
  const double G = material.E / (2 * (1 + material.nu));
  return {material.E * A,   material.E * I,   shear_coefficient * G * A,
          material.rho * A, material.rho * I, A,
          I / (depth / 2)};
}

inline Member member(std::string name, Index first, Index second, const Section& section,
                     Index elements = 1) {
  Member m;
  m.name = std::move(name);
  m.nodes = {first, second};
  m.section = m.end_section = section;
  m.elements = elements;
  return m;
}

/// Returns a member of one element that is hinged at both ends.
inline Member hinged(std::string name, Index first, Index second, const Section& section) {
  Member m = member(std::move(name), first, second, section);
  m.ends[0].fixity = m.ends[1].fixity = EndFixity::hinged;
  return m;
}

inline Support clamp(Index node) {
  return {"", node, {true, true, true}};
}
inline Support pin(Index node) {
  return {"", node, {true, true, false}};
}
inline Support roller(Index node) {
  return {"", node, {false, true, false}};
}

/// Returns a beam from the origin at an angle [rad], without supports.
inline Model beam(const Section& section, double length, Index elements, double angle = 0) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {length * std::cos(angle), length * std::sin(angle)}}};
  model.members = {member("AB", 0, 1, section, elements)};
  return model;
}

inline Model cantilever(const Section& section, double length, Index elements, double angle = 0) {
  Model model = beam(section, length, elements, angle);
  model.supports = {clamp(0)};
  return model;
}

/// Returns a section with EI = 1, 1 kg/m and a large axial stiffness.
inline Section unit_section(double EA = 1e6) {
  return {EA, 1, 0, 1, 0, 1, 1};
}

/// NAFEMS FV2: eight arms of 5 m from a common center, pinned at their tips.
inline Model pinned_double_cross(Index elements_an_arm) {
  const double pi = std::acos(-1.0);
  Model model;
  model.nodes = {{"center", {0, 0}}};
  const Section section = rectangle({200e9, 8000, 0.3}, 0.125, 0.125);
  for (Index k = 0; k < 8; ++k) {
    const double angle = static_cast<double>(k) * pi / 4;
    model.nodes.push_back({"tip" + std::to_string(k), {5 * std::cos(angle), 5 * std::sin(angle)}});
    model.members.push_back(member("arm" + std::to_string(k), 0, k + 1, section, elements_an_arm));
    model.supports.push_back(pin(k + 1));
  }
  return model;
}

/// Returns three collinear members of unequal length with slope 3/4, without supports.
inline Model inclined_line(BeamTheory theory) {
  Member part;
  part.section.EA = 1e6;
  part.section.EI = 1e3;
  part.section.kappa_GA = 4e5;
  part.end_section = part.section;
  part.theory = theory;
  return mesh_line({Vector2d(0, 0), Vector2d(1.6, 1.2), 3, 0.2}, part);
}

}  // namespace trammel::testing
