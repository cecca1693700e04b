#include "solver/large/large_motion_model.h"

#include <cmath>
#include <utility>

#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

void validate(const LargeMotionModel& large_motion, const Model& model) {
  const auto require = [](bool holds, const std::string& part, const std::string& what) {
    if (!holds) throw ModelError(part + ' ' + what);
  };
  const auto require_node = [&](Index node, const std::string& part) {
    require(node >= 0 && node < std::ssize(model.nodes), part, "refers to a missing node");
  };
  const auto require_direction = [&](int direction, const std::string& part) {
    require(direction >= 0 && direction <= 2, part, "must have direction 0, 1 or 2");
  };
  for (std::size_t i = 0; i < large_motion.drives.size(); ++i) {
    const Drive& drive = large_motion.drives[i];
    const std::string part = part_label("drive", drive.name, i);
    require_node(drive.node, part);
    if (drive.from != -1) require_node(drive.from, part);
    require_direction(drive.direction, part);
    require(static_cast<bool>(drive.law), part, "requires a function of time");
  }
  for (const Torque& torque : large_motion.torques) {
    require_node(torque.node, "a torque");
    require(static_cast<bool>(torque.law), "a torque", "requires a function of time");
  }
  for (std::size_t i = 0; i < large_motion.sliders.size(); ++i) {
    const Slider& slider = large_motion.sliders[i];
    const std::string part = part_label("slider", slider.name, i);
    require_node(slider.node, part);
    if (slider.rail != -1) require_node(slider.rail, part);
    require(slider.rail != slider.node, part, "has its own node as rail");
    require(std::isfinite(slider.direction), part, "has a direction that is not a finite number");
  }
  for (std::size_t i = 0; i < large_motion.line_springs.size(); ++i) {
    const LineSpring& spring = large_motion.line_springs[i];
    const std::string part = part_label("line spring", spring.name, i);
    for (const Index node : spring.nodes) require_node(node, part);
    require(std::isfinite(spring.stiffness) && spring.stiffness > 0, part,
            "must have a positive stiffness");
    require(model.nodes[to_size(spring.nodes[0])].position !=
                model.nodes[to_size(spring.nodes[1])].position,
            part, "joins coincident nodes, so that it has no direction");
  }
  for (const FollowerLoad& load : large_motion.follower_loads) {
    require_node(load.node, "a follower load");
    require(load.force.allFinite(), "a follower load", "is not a finite number");
  }
  for (const InitialVelocity& initial : large_motion.initial_velocities) {
    require_node(initial.node, "an initial velocity");
    require_direction(initial.direction, "an initial velocity");
    require(std::isfinite(initial.value), "an initial velocity", "is not a finite number");
  }
  for (const auto& [damping, part] :
       {std::pair(large_motion.mass_damping, "mass damping"),
        std::pair(large_motion.strain_rate_damping, "strain-rate damping")})
    require(std::isfinite(damping) && damping >= 0, part, "must not be negative");
}

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

void add_pin(Model& model, const std::string& name, const std::array<Index, 2>& nodes) {
  for (const auto kind : {Coordinate::Kind::x, Coordinate::Kind::y}) {
    const Coordinate first{kind, nodes[0], -1, 0}, second{kind, nodes[1], -1, 0};
    model.constraints.push_back({name, {{first, 1.0}, {second, -1.0}}});
  }
}

void add_small_motion_slider(Model& model, const large_motion::Slider& slider) {
  const Vector2d direction(std::cos(slider.direction), std::sin(slider.direction));
  const Vector2d normal = perpendicular(direction);
  using Kind = Coordinate::Kind;
  LinearConstraint no_normal_displacement{
      slider.name,
      {{{Kind::x, slider.node, -1, 0}, normal.x()}, {{Kind::y, slider.node, -1, 0}, normal.y()}}};
  LinearConstraint equal_rotation{slider.name, {{{Kind::rotation, slider.node, -1, 0}, 1.0}}};
  if (slider.rail >= 0) {
    const Vector2d offset =
        model.nodes[to_size(slider.node)].position - model.nodes[to_size(slider.rail)].position;
    const double lever = normal.dot(perpendicular(offset));
    no_normal_displacement.rail = {slider.rail, slider.node, direction};
    no_normal_displacement.terms.push_back({{Kind::x, slider.rail, -1, 0}, -normal.x()});
    no_normal_displacement.terms.push_back({{Kind::y, slider.rail, -1, 0}, -normal.y()});
    if (lever != 0)
      no_normal_displacement.terms.push_back({{Kind::rotation, slider.rail, -1, 0}, -lever});
    equal_rotation.terms.push_back({{Kind::rotation, slider.rail, -1, 0}, -1.0});
  }
  model.constraints.push_back(std::move(no_normal_displacement));
  if (slider.keeps_angle) model.constraints.push_back(std::move(equal_rotation));
}

}  // namespace trammel::solver
