#include "solver/large_motion/elements/linear_joints.h"

#include <cmath>

#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver {

void add_pin(Model& model, const std::string& name, const std::array<Index, 2>& nodes) {
  for (const auto kind : {Coordinate::Kind::x, Coordinate::Kind::y}) {
    const Coordinate first{kind, nodes[0], -1, 0}, second{kind, nodes[1], -1, 0};
    model.constraints.push_back({name, {{first, 1.0}, {second, -1.0}}});
  }
}

void add_linear_slider(Model& model, const large_motion::Slider& slider) {
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
