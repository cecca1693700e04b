#include "solver/linear/validate.h"

#include <algorithm>
#include <cmath>

#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/linear/constraints.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

void require(bool holds, const std::string& part, const char* what) {
  if (!holds) throw ModelError(part + ' ' + what);
}

/// Returns true for zero and positive finite numbers, and false for negative numbers, NaN and
/// infinity.
bool is_amount(double value) {
  return std::isfinite(value) && value >= 0;
}
bool is_positive(double value) {
  return std::isfinite(value) && value > 0;
}

class Validator {
 public:
  explicit Validator(const Model& model) : model_(model) {}

  void run() const {
    nodes();
    for (std::size_t i = 0; i < model_.members.size(); ++i) member(i);
    for (std::size_t i = 0; i < model_.plates.size(); ++i) plate(i);
    for (std::size_t i = 0; i < model_.triangles.size(); ++i) triangle(i);
    for (std::size_t i = 0; i < model_.rigid_bodies.size(); ++i) rigid_body(i);
    for (const PointMass& mass : model_.masses) point_mass(mass);
    for (std::size_t i = 0; i < model_.springs.size(); ++i) spring(i);
    for (std::size_t i = 0; i < model_.supports.size(); ++i)
      known(model_.supports[i].node, part_label("support", model_.supports[i].name, i));
    for (const NodalLoad& load : model_.loads) {
      known(load.node, "a load");
      require(load.force.allFinite(), "the load at " + node_label(model_, load.node),
              "is not a finite number");
    }
    for (const EdgeLoad& load : model_.edge_loads) edge_load(load);
    require(model_.gravity.allFinite(), "gravity", "is not a finite number");
  }

 private:
  void known(Index node, const std::string& part) const {
    if (node < 0 || node >= static_cast<Index>(model_.nodes.size()))
      throw ModelError(part + " refers to node " + std::to_string(node) + ", but the model has " +
                       std::to_string(model_.nodes.size()) + " nodes");
  }

  template <class Nodes>
  void on_plate(Index plate, const Nodes& nodes, std::size_t count, const std::string& part) const {
    require(plate >= 0 && plate < std::ssize(model_.plates), part,
            "refers to a plate that does not exist");
    for (std::size_t k = 0; k < count; ++k) known(nodes[k], part);
  }

  [[nodiscard]] const Vector2d& position(Index node) const {
    return model_.nodes[to_size(node)].position;
  }

  void nodes() const {
    require(!model_.nodes.empty(), "the model", "has no nodes");
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      require(model_.nodes[i].position.allFinite(), node_label(model_, static_cast<Index>(i)),
              "has a position that is not a finite number");
  }

  void member(std::size_t i) const {
    const Member& member = model_.members[i];
    const std::string part = member_label(model_, static_cast<Index>(i));
    for (const Index node : member.nodes) known(node, part);
    require(member.elements >= 1, part, "must have at least one element");
    const double length = (position(member.nodes[1]) - position(member.nodes[0])).norm();
    require(is_positive(length), part, "has no length");
    require(member.load.allFinite(), part, "has a load that is not a finite number");
    for (const MemberEnd& end : member.ends) {
      require(is_amount(end.stiffness), part, "has an end spring of negative stiffness");
      require(is_amount(end.inertia), part, "has an end of negative inertia");
    }
    const double middle = 0.5 / static_cast<double>(member.elements);
    for (const double at : {middle, 1 - middle}) section(member, section_at(member, at), part);
  }

  static void section(const Member& member, const Section& section, const std::string& part) {
    require(is_positive(section.EA) || !member.axially_flexible, part,
            "must have a positive axial stiffness E A");
    require(is_amount(section.EI), part, "must have a bending stiffness E I that is not negative");
    require(is_amount(section.mass_per_length), part, "has a negative mass");
    require(is_amount(section.inertia_per_length), part, "has a negative rotary inertia");
    if (section.EI > 0) {
      require(!has_shear_deformation(member.theory) || is_positive(section.kappa_GA), part,
              "has shear and must have a positive shear stiffness kappa G A");
      return;
    }
    const bool pinned = std::all_of(member.ends.begin(), member.ends.end(), [](const auto& end) {
      return end.fixity == EndFixity::hinged && end.inertia == 0;
    });
    require(pinned && member.elements == 1, part,
            "has no bending stiffness E I, so it must be one element hinged at both ends");
  }

  void plate(std::size_t i) const {
    const Plate& plate = model_.plates[i];
    const std::string part = part_label("plate", plate.name, i);
    require(is_positive(plate.material.E), part, "must have a positive Young's modulus");
    require(is_positive(plate.thickness), part, "must have a positive thickness");
    require(is_amount(plate.material.rho), part, "has a negative density");
    require(plate.material.nu > -1 && plate.material.nu < 1, part,
            "must have a Poisson's ratio between -1 and 1");
  }

  void triangle(std::size_t i) const {
    const Triangle& triangle = model_.triangles[i];
    const std::string part = "triangle " + std::to_string(i);
    on_plate(triangle.plate, triangle.nodes, triangle.quadratic() ? 6 : 3, part);
    const TrianglePoints p = triangle_nodes<3>(model_, triangle);
    const double longest = std::max(
        {(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    if (triangle.quadratic()) curved(triangle, part);
    if (!(std::abs(signed_area(p)) > 1e-12 * longest))
      throw ModelError(part + " (" + node_label(model_, triangle.nodes[0]) + ", " +
                       node_label(model_, triangle.nodes[1]) + ", " +
                       node_label(model_, triangle.nodes[2]) + ") has no area");
  }

  /// Checks that the mapping from area coordinates to a six-node triangle does not fold. The
  /// determinant of the mapping must have the same sign at all six nodes and at the centroid.
  void curved(const Triangle& triangle, const std::string& part) const {
    const auto area_at = [&](const Vector3d& at) {
      return evaluate_shape_functions(model_, triangle, at).signed_area;
    };
    const double at_center = area_at(Vector3d::Constant(1 / 3.0));
    for (const Vector3d& at : triangle_node_area_coordinates())
      require(area_at(at) * at_center > 0, part, "has mid-side nodes that fold it over itself");
  }

  void edge_load(const EdgeLoad& load) const {
    const std::string part = "an edge load";
    on_plate(load.plate, load.nodes, load.nodes[2] == -1 ? 2 : 3, part);
    require(load.traction.allFinite() && std::isfinite(load.normal), part,
            "is not a finite number");
  }

  void rigid_body(std::size_t i) const {
    const RigidBody& body = model_.rigid_bodies[i];
    const std::string part = part_label("rigid body", body.name, i);
    known(body.reference, part);
    for (const Index node : body.attached) known(node, part);
  }

  void point_mass(const PointMass& mass) const {
    known(mass.node, "a point mass");
    const std::string part = "the point mass at " + node_label(model_, mass.node);
    require(is_amount(mass.mass), part, "has a negative mass");
    require(is_amount(mass.inertia), part, "has a negative inertia");
    require(mass.offset.allFinite(), part, "has an offset that is not a finite number");
  }

  void spring(std::size_t i) const {
    const Spring& spring = model_.springs[i];
    const std::string part = part_label("spring", spring.name, i);
    known(spring.nodes[0], part);
    if (spring.nodes[1] != -1) known(spring.nodes[1], part);
    require(spring.nodes[0] != spring.nodes[1], part, "joins a node with itself");
    for (const double k : spring.stiffness)
      require(is_amount(k), part, "must have stiffnesses that are not negative");
  }

  const Model& model_;
};

}  // namespace

void validate(const Model& model) {
  Validator(model).run();
}

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

bool has_sprung_end(const Member& member) {
  return std::any_of(member.ends.begin(), member.ends.end(),
                     [](const MemberEnd& end) { return end.fixity == EndFixity::sprung; });
}

bool any_part_weighs(const Model& model) {
  if (model.gravity.isZero(0)) return false;
  return std::any_of(model.members.begin(), model.members.end(), weighs) ||
         std::any_of(model.masses.begin(), model.masses.end(),
                     [](const PointMass& point_mass) { return point_mass.mass > 0; }) ||
         std::any_of(model.plates.begin(), model.plates.end(),
                     [](const Plate& plate) { return plate.material.rho > 0; });
}

void remove_mass_of_section(Section& section) {
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
  remove_mass_of_section(member.section);
  remove_mass_of_section(member.end_section);
}

}  // namespace

Effects applicable_effects(const Model& model) {
  Effects effects;
  for (const Member& member : model.members) {
    if (member.axially_flexible && bends(member)) effects = effects.with(Effect::axial_flexibility);
    if (has_shear_deformation(member.theory) && bends(member))
      effects = effects.with(Effect::shear);
    if (has_rotary_inertia(member.theory) && has_rotary_inertia_per_length(member))
      effects = effects.with(Effect::rotary_inertia);
    if (has_sprung_end(member)) effects = effects.with(Effect::joint_compliance);
    if (has_inertia(member)) effects = effects.with(Effect::link_mass);
  }
  if (any_part_weighs(model)) effects = effects.with(Effect::gravity);
  return effects;
}

Model restrict_effects(Model model, Effects active) {
  for (Member& member : model.members) restrict_effects(member, active);
  if (!active.has(Effect::gravity)) model.gravity.setZero();
  return model;
}

bool is_axially_overconstrained(const Model& model) {
  Model stiff = restrict_effects(model, Effects::all().without(Effect::axial_flexibility));
  // One element is sufficient, because interior nodes follow the member ends.
  for (Member& member : stiff.members) member.elements = 1;
  const Constraints constraints = build_constraints(stiff, discretize(stiff));
  for (std::size_t i = 0; i < constraints.rows.size(); ++i) {
    const bool along = constraints.rows[i].source == ConstraintRow::Source::inextensible;
    if (along && constraints.pivot[i] < 0) return true;
  }
  return false;
}

}  // namespace trammel::solver
