#pragma once

#include <array>
#include <string>

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/model.h"

/// JSON keys and C++ members of the parts of a planar model, each listed once. `FieldReader`, the
/// writer of exported cases and a test that compares the keys with the schema use the same list:
///
///   io.required(key, member);   always written
///   io.defaulted(key, member);  optional in the schema, and always written
///   io.optional(key, member);   omitted if zero, empty or the first enumeration value
///
/// Only cases/schema/case.schema.json defines ranges and documentation of the keys. The keys
/// contain the units.
namespace trammel::harness {

TRAMMEL_WORDS(solver::BeamTheory, "euler-bernoulli", "rayleigh", "shear", "timoshenko");
TRAMMEL_WORDS(solver::MassMatrix, "consistent", "lumped");
TRAMMEL_WORDS(solver::EndFixity, "welded", "hinged");
TRAMMEL_WORDS(solver::Taper, "linear-area-and-inertia", "linear-depth-and-width", "exponential");
TRAMMEL_WORDS(solver::PlatformKind, "rigid", "triangles");
TRAMMEL_WORDS(solver::ActiveKind, "locked", "free");
TRAMMEL_WORDS(solver::ElbowKind, "welded", "hinged");
TRAMMEL_WORDS(solver::PlatformJointKind, "hinged", "welded", "", "eq25-mean", "eq25-sum");
TRAMMEL_WORDS(solver::SplineEnds, "natural", "at-rest", "periodic");
TRAMMEL_WORDS(solver::EigenMethod, "automatic", "dense", "sparse");
enum class Axial { flexible, inextensible };
TRAMMEL_WORDS(Axial, "flexible", "inextensible");
enum class NodeMotion { x, y, rotation };
TRAMMEL_WORDS(NodeMotion, "x", "y", "rotation");

/// List of node indices. The case file contains the names of these nodes.
template <class Indices>
struct NodeNames {
  explicit NodeNames(Indices& all) : indices(all) {}
  Indices& indices;
};

template <class Io>
void visit_fields(Io& io, solver::Material& material) {
  io.required("E_Pa", material.E);
  io.required("rho_kg_m3", material.rho);
  io.required("nu", material.nu);
}

template <class Io>
void visit_fields(Io& io, solver::Member& member) {
  io.required("nodes", NodeNames{member.nodes});
  io.required("section", member.section);
  io.defaulted("beam", member.theory);
  io.defaulted("elements", member.elements);
  io.defaulted("ends", member.ends);
  io.optional("mass_matrix", member.mass);
  Axial axial = member.axially_flexible ? Axial::flexible : Axial::inextensible;
  io.optional("axial", axial);
  member.axially_flexible = axial == Axial::flexible;
  io.optional("load_N_per_m", member.load);
  Eigen::Vector2d inertia(member.ends[0].inertia, member.ends[1].inertia);
  io.optional("end_inertia_kg_m2", inertia);
  member.ends[0].inertia = inertia[0];
  member.ends[1].inertia = inertia[1];
}

template <class Io>
void visit_fields(Io& io, solver::Plate& plate) {
  io.required("material", plate.material);
  io.required("thickness_m", plate.thickness);
}

template <class Io>
void visit_fields(Io& io, solver::RigidBody& body) {
  io.required("reference", NodeNames{body.reference});
  io.required("nodes", NodeNames{body.attached});
}

template <class Io>
void visit_fields(Io& io, solver::PointMass& mass) {
  io.required("node", NodeNames{mass.node});
  io.required("mass_kg", mass.mass);
  io.defaulted("inertia_kg_m2", mass.inertia);
  io.defaulted("offset_m", mass.offset);
}

template <class Io>
void visit_fields(Io& io, solver::Spring& spring) {
  io.required("nodes", NodeNames{spring.nodes});
  io.defaulted("stiffness_N_per_m", spring.stiffness.head<2>());
  io.defaulted("rotational_stiffness_N_m_per_rad", spring.stiffness.z());
}

/// Pin: two nodes at the same position that move together and rotate independently.
struct Pin {
  std::string name;
  std::array<solver::Index, 2> nodes{};
};
template <class Io>
void visit_fields(Io& io, Pin& pin) {
  io.required("nodes", NodeNames{pin.nodes});
}

template <class Io>
void visit_fields(Io& io, solver::large_motion::Slider& slider) {
  io.required("node", NodeNames{slider.node});
  io.required("direction_rad", slider.direction);
  io.defaulted("keeps_angle", slider.keeps_angle);
  io.optional("rail", NodeNames{slider.rail});
}

template <class Io>
void visit_fields(Io& io, solver::large_motion::LineSpring& spring) {
  io.required("nodes", NodeNames{spring.nodes});
  io.required("stiffness_N_per_m", spring.stiffness);
  io.optional("rest_length_m", spring.rest_length);
}

/// Loads on nodes. The direction of the force is fixed, or rotates with the node (follower load).
template <class Io, class Load>
requires requires(Load load) {
  load.node, load.force;
}
void visit_fields(Io& io, Load& load) {
  io.optional("node", NodeNames{load.node});
  io.defaulted("force_N", load.force.template head<2>());
  io.optional("moment_N_m", load.force.z());
}

}  // namespace trammel::harness
