#include "solver/large_motion/system/system_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/elements/edge_load.h"
#include "solver/model/labels.h"

namespace trammel::solver::large_motion {

namespace {

class PartsBuilder {
 public:
  PartsBuilder(const Model& model, const LargeMotionModel& large_motion, const Layout& layout)
      : model_(model), large_motion_(large_motion), layout_(layout) {}

  SystemParts run() {
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
    parts_.for_each_group([&](auto& group) {
      group.set_first_row(parts_.rows);
      parts_.rows += group.rows();
    });
    return std::move(parts_);
  }

 private:
  template <class Element>
  Index add(Element element, const CoordinateIndices<Element::N>& where) {
    auto& group = std::get<ElementGroup<Element>>(parts_.groups);
    group.add(std::move(element), where);
    return group.size() - 1;
  }

  /// Coordinate of a node, -1 on the ground.
  [[nodiscard]] Index coordinate(Index node, std::size_t direction) const {
    return node < 0 ? node : layout_.node[to_size(node)][direction];
  }

  /// From the first node to the second in the model's pose [m].
  [[nodiscard]] Vector2d offset(Index from, Index to) const {
    return model_.nodes[to_size(to)].position - model_.nodes[to_size(from)].position;
  }

  /// Zero compliance if the member's theory excludes a strain.
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
      for (const Index k : layout_.mass_centre[i]) add_inertia(k, mass.mass);
      add_inertia(coordinate(mass.node, 2), mass.inertia);
      if (!mass.offset.isZero(0)) add_rigid_link(mass.node, layout_.mass_centre[i], mass.offset);
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

  /// Adds one row a drive, in their order.
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

  /// A constraint that makes two coordinates equal is one coordinate of the layout instead.
  void add_linear_constraints() {
    for (const LinearConstraint& constraint : model_.constraints) {
      if (layout_.equated_coordinates(constraint)) continue;
      std::vector<double> factors;
      std::vector<Index> coordinates;
      for (const auto& [coordinate, factor] : constraint.terms) {
        factors.push_back(factor);
        coordinates.push_back(layout_.index_of(coordinate));
        if (coordinates.back() < 0)
          throw ModelError("constraint " + constraint.name + " names a rotation that no part has");
      }
      const Index rotations =
          std::ranges::count_if(coordinates, [&](Index k) { return layout_.is_rotation(k); });
      if (rotations != 0 && rotations != std::ssize(coordinates)) {
        throw ModelError("constraint " + constraint.name +
                         " mixes translations and rotations: it holds for small motion only");
      }
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

  const Model& model_;
  const LargeMotionModel& large_motion_;
  const Layout& layout_;
  SystemParts parts_;
};

}  // namespace

SystemParts build_parts(const Model& model, const LargeMotionModel& large_motion,
                        const Layout& layout) {
  return PartsBuilder(model, large_motion, layout).run();
}

void require_driven_parts(const Model& model, const LargeMotionModel& large_motion,
                          const Layout& layout, const std::vector<std::vector<Index>>& blocks,
                          const VectorXd& mass) {
  for (const Drive& drive : large_motion.drives) {
    const Index driven = layout.node[to_size(drive.node)][to_size(drive.direction)];
    const auto couples = [driven](const std::vector<Index>& block) {
      return std::ranges::find(block, driven) != block.end();
    };
    // One of the blocks is that of the drive.
    if (mass[driven] != 0 || std::ranges::count_if(blocks, couples) > 1) continue;
    throw ModelError(part_label("drive", drive.name, 0) + " moves nothing: no member end, body, " +
                     "spring or mass is joined to " +
                     (drive.direction == 2 ? "the rotation of " : "") +
                     node_label(model, drive.node));
  }
}

}  // namespace trammel::solver::large_motion
