#include "solver/elements/edge_load.h"

#include "solver/model/quadrature.h"

namespace trammel::solver {

SideShape side_shape(bool quadratic, double s) {
  if (!quadratic) return {{1 - s, s, 0}, {-1, 1, 0}};
  return {{(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)},
          {4 * s - 3, 4 * s - 1, 4 - 8 * s}};
}

std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load) {
  std::array<Vector2d, 3> points = {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  for (std::size_t i = 0; i < 3; ++i) {
    if (load.nodes[i] < 0) continue;
    points[i] = model.nodes[static_cast<std::size_t>(load.nodes[i])].position;
  }
  const bool quadratic = load.nodes[2] >= 0;
  const double thickness = model.plates[static_cast<std::size_t>(load.plate)].thickness;
  std::array<Vector2d, 3> forces = {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const auto [N, dN] = side_shape(quadratic, point.xi);
    const Vector2d tangent = dN[0] * points[0] + dN[1] * points[1] + dN[2] * points[2];
    const Vector2d normal(tangent.y(), -tangent.x());
    const Vector2d traction = tangent.norm() * load.traction + load.normal * normal;
    for (std::size_t i = 0; i < 3; ++i) forces[i] += point.weight * thickness * N[i] * traction;
  }
  return forces;
}

}  // namespace trammel::solver
