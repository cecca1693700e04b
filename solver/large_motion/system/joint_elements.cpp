#include "solver/large_motion/system/joint_elements.h"

#include <algorithm>
#include <cmath>

#include "solver/large_motion/elements/joints.h"
#include "solver/model/labels.h"

namespace trammel::solver::large_motion {

namespace {

/// From the first node to the second in the model's pose [m].
Vector2d node_offset(const Model& model, Index from, Index to) {
  return model.nodes[to_size(to)].position - model.nodes[to_size(from)].position;
}

}  // namespace

void add_rigid_links(const Model& model, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<RigidLink>>(layout.free, parts.rows);
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const PointMass& mass = model.masses[i];
    const std::array<Index, 3>& node = layout.node[to_size(mass.node)];
    const std::array<Index, 2>& centre = layout.mass_centre[i];
    for (const Index k : centre) parts.point_mass.emplace_back(k, mass.mass);
    if (mass.inertia != 0) parts.point_mass.emplace_back(node[2], mass.inertia);
    if (mass.offset.isZero(0)) continue;
    RigidLink link;
    link.offset = mass.offset;
    group->add(link, {node[0], node[1], node[2], centre[0], centre[1]});
  }
  for (const RigidBody& body : model.rigid_bodies) {
    const std::array<Index, 3>& a = layout.node[to_size(body.reference)];
    for (const Index attached : body.attached) {
      const std::array<Index, 3>& b = layout.node[to_size(attached)];
      RigidLink link;
      link.offset = node_offset(model, body.reference, attached);
      group->add(link, {a[0], a[1], a[2], b[0], b[1]});
    }
  }
  parts.add(std::move(group));
}

void add_sliders(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                 SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<SlidingJoint>>(layout.free, parts.rows);
  for (const Slider& slider : large_motion.sliders) {
    SlidingJoint joint;
    joint.normal = Vector2d(-std::sin(slider.direction), std::cos(slider.direction));
    std::array<Index, 3> rail{-1, -1, -1};
    if (slider.rail >= 0) {
      rail = layout.node[to_size(slider.rail)];
      joint.offset = node_offset(model, slider.rail, slider.node);
    }
    const std::array<Index, 3>& node = layout.node[to_size(slider.node)];
    group->add(joint, {rail[0], rail[1], rail[2], node[0], node[1]});
  }
  parts.add(std::move(group));
}

void add_line_springs(const Model& model, const LargeMotionModel& large_motion,
                      const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<LineSpringElement>>(layout.free, parts.rows);
  for (const LineSpring& spring : large_motion.line_springs) {
    LineSpringElement element;
    element.offset = node_offset(model, spring.nodes[0], spring.nodes[1]);
    if (std::isfinite(spring.rest_length)) {
      element.initial_elongation = element.offset.norm() - spring.rest_length;
    }
    element.flexibility = 1 / spring.stiffness;
    const auto& a = layout.node[to_size(spring.nodes[0])];
    const auto& b = layout.node[to_size(spring.nodes[1])];
    group->add(element, {a[0], a[1], b[0], b[1]});
  }
  parts.add(std::move(group));
}

void add_drives(const LargeMotionModel& large_motion, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<DrivenCoordinate>>(layout.free, parts.rows);
  parts.first_drive_row = parts.rows;
  for (const Drive& drive : large_motion.drives) {
    DrivenCoordinate driven;
    driven.law = drive.law;
    const auto coordinate = [&](Index node) {
      return node < 0 ? node : layout.node[to_size(node)][to_size(drive.direction)];
    };
    group->add(driven, {coordinate(drive.node), coordinate(drive.from)});
  }
  parts.add(std::move(group));
}

void require_driven_parts(const Model& model, const LargeMotionModel& large_motion,
                          const Layout& layout, const std::vector<std::vector<Index>>& blocks,
                          const VectorXd& mass) {
  for (const Drive& drive : large_motion.drives) {
    const Index driven = layout.node[to_size(drive.node)][to_size(drive.direction)];
    const auto couples = [driven](const std::vector<Index>& block) {
      return std::find(block.begin(), block.end(), driven) != block.end();
    };
    // One of the blocks is the drive's own.
    if (mass[driven] != 0 || std::count_if(blocks.begin(), blocks.end(), couples) > 1) continue;
    throw ModelError(part_label("drive", drive.name, 0) + " moves nothing: no member end, body, " +
                     "spring or mass is joined to " +
                     (drive.direction == 2 ? "the rotation of " : "") +
                     node_label(model, drive.node));
  }
}

}  // namespace trammel::solver::large_motion
