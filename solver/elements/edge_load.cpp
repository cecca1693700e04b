#include "solver/elements/edge_load.h"

#include "solver/model/quadrature.h"

namespace trammel::solver {
namespace {

/// Shape functions of a side's ends and its middle, and their derivatives, at a fraction of it.
struct SideShape {
  std::array<double, 3> N, dN;
};
SideShape side_shape(bool quadratic, double s) {
  if (!quadratic) return {{1 - s, s, 0}, {-1, 1, 0}};
  return {{(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)},
          {4 * s - 3, 4 * s - 1, 4 - 8 * s}};
}

}  // namespace

std::array<Vector2d, 3> side_forces(const Model& model, Index plate,
                                    const std::array<Index, 3>& nodes, const SideLoad& load) {
  const double thickness = model.plates[to_size(plate)].thickness;
  std::array<Vector2d, 3> forces = {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const auto [N, dN] = side_shape(nodes[2] >= 0, point.xi);
    Vector2d position = Vector2d::Zero(), tangent = Vector2d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (nodes[i] < 0) continue;
      position += N[i] * model.nodes[to_size(nodes[i])].position;
      tangent += dN[i] * model.nodes[to_size(nodes[i])].position;
    }
    const Vector2d force = point.weight * thickness * load(position, tangent);
    for (std::size_t i = 0; i < 3; ++i) forces[i] += N[i] * force;
  }
  return forces;
}

std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load) {
  return side_forces(
      model, load.plate, load.nodes, [&](const Vector2d&, const Vector2d& tangent) -> Vector2d {
        return tangent.norm() * load.traction + load.normal * Vector2d(tangent.y(), -tangent.x());
      });
}

}  // namespace trammel::solver
