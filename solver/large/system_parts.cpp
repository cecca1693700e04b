#include "solver/large/system_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/linear/validate.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

namespace {

/// Sets of coordinates that are equal. Each set is represented by one of its coordinates.
class MergedSets {
 public:
  Index add() {
    parent_.push_back(std::ssize(parent_));
    return parent_.back();
  }
  [[nodiscard]] Index find(Index i) const {
    while (parent_[to_size(i)] != i) i = parent_[to_size(i)];
    return i;
  }
  /// Merges the sets of two coordinates. The merged set is represented by the representative of
  /// `second`.
  void merge(Index first, Index second) { parent_[to_size(find(first))] = find(second); }

 private:
  std::vector<Index> parent_;
};

/// Numbers the coordinates and builds the elements. At first, every node has three coordinates.
/// Rotations on which no element or moment acts are removed after the elements are added.
class SystemBuilder {
 public:
  SystemBuilder(const Model& model, const LargeMotionModel& large_motion, Layout& layout)
      : model_(model), large_motion_(large_motion), layout_(layout) {}

  SystemParts run() {
    number_nodes();
    for (std::size_t m = 0; m < model_.members.size(); ++m) number_member(static_cast<Index>(m));
    layout_.first_element.push_back(std::ssize(layout_.elements));
    number_masses();
    parts_.loads = VectorXd::Zero(layout_.total);
    add_members();
    for (const Triangle& triangle : model_.triangles) {
      if (triangle.quadratic()) {
        add_triangle<6>(triangle);
      } else {
        add_triangle<3>(triangle);
      }
    }
    add_springs();
    add_masses();
    add_rigid_bodies();
    add_sliders();
    add_line_springs();
    add_drives();
    add_linear_constraints();
    add_loads();
    renumber_free_first();
    parts_.for_each_group([&](auto& group) {
      group.set_first_constraint_row(parts_.rows);
      parts_.rows += group.constraint_row_count();
    });
    return std::move(parts_);
  }

 private:
  Index add_coordinate(int direction) {
    layout_.direction.push_back(direction);
    ++layout_.total;
    return shared_.add();
  }

  std::array<Index, 3> add_node() {
    const Index x = add_coordinate(0), y = add_coordinate(1);
    return {x, y, add_coordinate(2)};
  }

  void number_nodes() {
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) layout_.node.push_back(add_node());
    for (const RigidBody& body : model_.rigid_bodies) {
      for (const Index node : body.attached)
        shared_.merge(coordinate(node, 2), coordinate(body.reference, 2));
    }
  }

  void number_member(Index m) {
    const Member& member = model_.members[to_size(m)];
    const double count = static_cast<double>(member.elements);
    const Vector2d& from = model_.nodes[to_size(member.nodes[0])].position;
    const Vector2d span = offset(member.nodes[0], member.nodes[1]);
    const bool bends = section_at(member, 0.5).EI > 0;
    std::array<std::array<Index, 3>, 2> ends{};
    for (std::size_t end = 0; end < 2; ++end) {
      ends[end] = layout_.node[to_size(member.nodes[end])];
      if (!bends) {
        ends[end][2] = -1;
      } else if (member.ends[end].fixity != EndFixity::welded) {
        ends[end][2] = add_coordinate(2);
      }
    }
    layout_.end_rotation.push_back({ends[0][2], ends[1][2]});
    layout_.first_element.push_back(std::ssize(layout_.elements));
    std::array<Index, 3> left = ends[0];
    for (Index e = 0; e < member.elements; ++e) {
      const double begin = static_cast<double>(e);
      MemberElement element;
      element.member = m;
      element.start = from + begin / count * span;
      element.end = from + (begin + 1) / count * span;
      element.section = section_at(member, (begin + 0.5) / count);
      const auto append = [&](const std::array<Index, 3>& node) {
        element.coordinates.insert(element.coordinates.end(), node.begin(),
                                   node.end() - (bends ? 0 : 1));
      };
      append(left);
      for (int inner = 2; bends && inner < BeamInterpolation::kNodes; ++inner) append(add_node());
      left = e + 1 == member.elements ? ends[1] : add_node();
      append(left);
      layout_.elements.push_back(std::move(element));
    }
  }

  void number_masses() {
    for (const PointMass& mass : model_.masses) {
      const auto& [x, y, rotation] =
          mass.offset.isZero(0) ? layout_.node[to_size(mass.node)] : add_node();
      layout_.mass_center.push_back({x, y});
    }
  }

  template <class Element>
  Index add(Element element, const CoordinateIndices<Element::N>& where) {
    auto& group = std::get<ElementGroup<Element>>(parts_.groups);
    group.add(std::move(element), where);
    return group.size() - 1;
  }

  /// Returns the index of a coordinate of a node, or a negative number for the ground.
  [[nodiscard]] Index coordinate(Index node, std::size_t direction) const {
    return node < 0 ? node : layout_.node[to_size(node)][direction];
  }

  /// Returns the vector from the first node to the second in the pose of the model [m].
  [[nodiscard]] Vector2d offset(Index from, Index to) const {
    return model_.nodes[to_size(to)].position - model_.nodes[to_size(from)].position;
  }

  /// Creates a beam. A strain that the theory of the member excludes has zero compliance.
  static Beam make_beam(const Member& member, const MemberElement& element) {
    const Section& section = element.section;
    Beam beam;
    beam.length = element.length();
    beam.axis = (element.end - element.start) / beam.length;
    beam.EI = section.EI;
    beam.stretch_compliance = member.axially_flexible ? 1 / section.EA : 0.0;
    beam.mass_per_length = section.mass_per_length;
    beam.lumped = member.mass == MassMatrix::lumped;
    if (has_shear_deformation(member.theory)) beam.shear_compliance = 1 / section.kappa_GA;
    if (has_rotary_inertia(member.theory)) beam.inertia_per_length = section.inertia_per_length;
    return beam;
  }

  static Bar make_bar(const Member& member, const MemberElement& element) {
    Bar bar;
    bar.offset = element.end - element.start;
    bar.flexibility = member.axially_flexible ? element.length() / element.section.EA : 0.0;
    bar.total_mass = element.length() * element.section.mass_per_length;
    bar.lumped = member.mass == MassMatrix::lumped;
    return bar;
  }

  template <class Element>
  void add_member_element(const Element& part, const MemberElement& element, const Vector2d& load) {
    const Eigen::Map<const CoordinateIndices<Element::N>> where(element.coordinates.data());
    parts_.group_index.push_back(add(part, where));
    scatter<Element::N>(part.distributed_load(load), where, parts_.loads);
  }

  void add_members() {
    for (const MemberElement& element : layout_.elements) {
      const Member& member = model_.members[to_size(element.member)];
      if (element.is_bar()) {
        add_member_element(make_bar(member, element), element, member.load);
      } else {
        add_member_element(make_beam(member, element), element, member.load);
      }
    }
    for (std::size_t m = 0; m < model_.members.size(); ++m) {
      for (std::size_t end = 0; end < 2; ++end)
        add_inertia(layout_.end_rotation[m][end], model_.members[m].ends[end].inertia);
    }
  }

  template <int Nodes>
  void add_triangle(const Triangle& triangle) {
    CoordinateIndices<2 * Nodes> where;
    for (Index i = 0; i < where.size(); ++i)
      where[i] = coordinate(triangle.nodes[to_size(i / 2)], to_size(i % 2));
    add(Triangle2d<Nodes>(model_, triangle), where);
  }

  void add_springs() {
    const auto add_spring = [&](double stiffness, Index first, Index second) {
      CoordinateSpring spring;
      spring.stiffness = stiffness;
      if (stiffness != 0) add(spring, {first, second});
    };
    for (const Spring& spring : model_.springs) {
      for (std::size_t k = 0; k < 3; ++k)
        add_spring(spring.stiffness[static_cast<Index>(k)], coordinate(spring.nodes[0], k),
                   coordinate(spring.nodes[1], k));
    }
    for (std::size_t m = 0; m < model_.members.size(); ++m) {
      for (std::size_t end = 0; end < 2; ++end) {
        const MemberEnd& fixity = model_.members[m].ends[end];
        if (fixity.fixity == EndFixity::sprung)
          add_spring(fixity.stiffness, coordinate(model_.members[m].nodes[end], 2),
                     layout_.end_rotation[m][end]);
      }
    }
  }

  void add_inertia(Index coordinate, double value) {
    PointInertia inertia;
    inertia.value = value;
    if (value != 0) add(inertia, CoordinateIndices<1>(coordinate));
  }

  void add_rigid_link(Index node, const std::array<Index, 2>& end, const Vector2d& offset) {
    const auto& [x, y, rotation] = layout_.node[to_size(node)];
    RigidLink link;
    link.offset = offset;
    add(link, {x, y, rotation, end[0], end[1]});
  }

  void add_masses() {
    for (std::size_t i = 0; i < model_.masses.size(); ++i) {
      const PointMass& mass = model_.masses[i];
      for (const Index k : layout_.mass_center[i]) add_inertia(k, mass.mass);
      add_inertia(coordinate(mass.node, 2), mass.inertia);
      if (!mass.offset.isZero(0)) add_rigid_link(mass.node, layout_.mass_center[i], mass.offset);
    }
  }

  void add_rigid_bodies() {
    for (const RigidBody& body : model_.rigid_bodies) {
      for (const Index attached : body.attached)
        add_rigid_link(body.reference, {coordinate(attached, 0), coordinate(attached, 1)},
                       offset(body.reference, attached));
    }
  }

  void add_sliders() {
    for (const Slider& slider : large_motion_.sliders) {
      SlidingJoint joint;
      joint.normal = Vector2d(-std::sin(slider.direction), std::cos(slider.direction));
      if (slider.rail >= 0) joint.offset = offset(slider.rail, slider.node);
      add(joint,
          {coordinate(slider.rail, 0), coordinate(slider.rail, 1), coordinate(slider.rail, 2),
           coordinate(slider.node, 0), coordinate(slider.node, 1)});
      if (slider.keeps_angle)
        add_row({-1, 1}, {coordinate(slider.rail, 2), coordinate(slider.node, 2)});
    }
  }

  void add_line_springs() {
    for (const LineSpring& spring : large_motion_.line_springs) {
      const auto& [first, second] = spring.nodes;
      LineSpringElement element;
      element.offset = offset(first, second);
      if (std::isfinite(spring.rest_length))
        element.initial_elongation = element.offset.norm() - spring.rest_length;
      element.flexibility = 1 / spring.stiffness;
      add(element, {coordinate(first, 0), coordinate(first, 1), coordinate(second, 0),
                    coordinate(second, 1)});
    }
  }

  /// Adds one constraint row per drive, in the order of the drives.
  void add_drives() {
    for (const Drive& drive : large_motion_.drives) {
      DrivenCoordinate driven;
      driven.law = drive.law;
      const std::size_t direction = to_size(drive.direction);
      add(driven, {coordinate(drive.node, direction), coordinate(drive.from, direction)});
    }
  }

  void add_row(const std::vector<double>& factors, const std::vector<Index>& coordinates) {
    const Index count = std::ssize(factors);
    LinearRow row;
    row.factors = Eigen::Map<const VectorXd>(factors.data(), count);
    add(row, Eigen::Map<const CoordinateIndices<Eigen::Dynamic>>(coordinates.data(), count));
  }

  [[nodiscard]] Index index_of(const Coordinate& named) const {
    if (named.kind == Coordinate::Kind::end_rotation)
      return layout_.end_rotation[to_size(named.member)][to_size(named.end)];
    return coordinate(named.node, static_cast<std::size_t>(named.kind));
  }

  /// Adds linear constraints. A constraint that makes two coordinates equal, as in a revolute joint
  /// between coincident nodes, merges them into one coordinate.
  void add_linear_constraints() {
    for (const LinearConstraint& constraint : model_.constraints) {
      std::vector<double> factors;
      std::vector<Index> coordinates;
      for (const auto& [coordinate, factor] : constraint.terms) {
        factors.push_back(factor);
        coordinates.push_back(index_of(coordinate));
        if (coordinates.back() < 0)
          throw ModelError("constraint " + constraint.name +
                           " refers to the rotation of a node or member end without rotation");
      }
      if (factors.size() == 2 && factors[0] != 0 && factors[0] == -factors[1]) {
        shared_.merge(coordinates[0], coordinates[1]);
        continue;
      }
      const Index rotations =
          std::ranges::count_if(coordinates, [&](Index k) { return layout_.is_rotation(k); });
      if (rotations != 0 && rotations != std::ssize(coordinates))
        throw ModelError("constraint " + constraint.name +
                         " mixes translations and rotations, which requires small displacements");
      add_row(factors, coordinates);
    }
  }

  void add_loads() {
    for (const NodalLoad& load : model_.loads) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double force = load.force[static_cast<Index>(k)];
        if (force != 0) parts_.loads[coordinate(load.node, k)] += force;
      }
    }
    for (const EdgeLoad& load : model_.edge_loads) {
      const std::array<Vector2d, 3> force = edge_forces(model_, load);
      for (std::size_t i = 0; i < 3; ++i)
        scatter<2>(force[i], {coordinate(load.nodes[i], 0), coordinate(load.nodes[i], 1)},
                   parts_.loads);
    }
    for (const FollowerLoad& load : large_motion_.follower_loads) {
      const auto& [x, y, rotation] = layout_.node[to_size(load.node)];
      FollowerForce follower;
      follower.force = load.force;
      add(follower, {x, y, rotation});
    }
  }

  /// Counts the elements and moments that use each coordinate.
  /// @throws ModelError  if a drive moves an unconnected coordinate.
  std::vector<int> count_uses() {
    std::vector<int> uses(to_size(layout_.total), 0);
    const auto use = [&](Index k) {
      if (k >= 0) ++uses[to_size(shared_.find(k))];
    };
    parts_.for_each_group([&](auto& group) { group.for_each_coordinate(use); });
    for (const Drive& drive : large_motion_.drives) {
      const Index driven = shared_.find(coordinate(drive.node, to_size(drive.direction)));
      if (uses[to_size(driven)] > 1) continue;
      throw ModelError(part_label("drive", drive.name, 0) + " moves nothing: no member end, " +
                       "body, spring or mass is joined to " +
                       (drive.direction == 2 ? "the rotation of " : "") +
                       node_label(model_, drive.node));
    }
    for (const Torque& torque : large_motion_.torques) use(coordinate(torque.node, 2));
    for (Index k = 0; k < layout_.total; ++k)
      if (parts_.loads[k] != 0) use(k);
    return uses;
  }

  /// Returns true for each representative coordinate (`MergedSets`) that a support holds.
  [[nodiscard]] std::vector<bool> held_coordinates() const {
    std::vector<bool> held(to_size(layout_.total), false);
    for (const Support& support : model_.supports) {
      for (std::size_t k = 0; k < 3; ++k)
        if (support.fixed[k]) held[to_size(shared_.find(coordinate(support.node, k)))] = true;
    }
    for (const Drive& drive : large_motion_.drives) {
      if (held[to_size(shared_.find(coordinate(drive.node, to_size(drive.direction))))])
        throw ModelError(part_label("drive", drive.name, 0) + " moves a supported coordinate");
    }
    return held;
  }

  void renumber_free_first() {
    const std::vector<bool> held = held_coordinates();
    const std::vector<int> uses = count_uses();
    std::vector<Index> new_index(to_size(layout_.total), -1);
    std::vector<int> direction;
    for (const bool fixed : {false, true}) {
      for (Index i = 0; i < layout_.total; ++i) {
        const bool exists = !layout_.is_rotation(i) || uses[to_size(i)] > 0;
        if (shared_.find(i) != i || held[to_size(i)] != fixed || !exists) continue;
        new_index[to_size(i)] = std::ssize(direction);
        direction.push_back(layout_.direction[to_size(i)]);
      }
      if (!fixed) layout_.free = std::ssize(direction);
    }
    const auto renumber = [&](Index& i) {
      if (i >= 0) i = new_index[to_size(shared_.find(i))];
    };
    const auto renumber_all = [&](auto& coordinates) {
      std::ranges::for_each(coordinates, renumber);
    };
    VectorXd loads = VectorXd::Zero(std::ssize(direction));
    for (Index i = 0; i < layout_.total; ++i) {
      Index k = i;
      renumber(k);
      if (k >= 0) loads[k] += parts_.loads[i];
    }
    parts_.loads = std::move(loads);
    layout_.total = std::ssize(direction);
    layout_.direction = std::move(direction);
    std::ranges::for_each(layout_.node, renumber_all);
    std::ranges::for_each(layout_.end_rotation, renumber_all);
    std::ranges::for_each(layout_.mass_center, renumber_all);
    for (MemberElement& element : layout_.elements) renumber_all(element.coordinates);
    parts_.for_each_group([&](auto& group) { group.for_each_coordinate(renumber); });
  }

  const Model& model_;
  const LargeMotionModel& large_motion_;
  Layout& layout_;
  SystemParts parts_;
  MergedSets shared_;  ///< sets of equal coordinates
};

}  // namespace

Vector2d MemberElement::position(std::size_t node) const {
  const double x = is_bar() ? static_cast<double>(node) : beam_interpolation().node[node];
  return start + x * (end - start);
}

SystemParts build_parts(const Model& model, const LargeMotionModel& large_motion, Layout& layout) {
  validate(model);
  validate(large_motion, model);
  return SystemBuilder(model, large_motion, layout).run();
}

}  // namespace trammel::solver::large_motion
