#include "solver/assembly/consistent_load.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "solver/assembly/strain.h"
#include "solver/elements/edge_load.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {
namespace {

void project(System& system) {
  system.f = system.T.transpose() * system.load;
}

using Side = std::pair<Index, Index>;

Side side_of(const Triangle& triangle, std::size_t k) {
  return std::minmax(triangle.nodes[k], triangle.nodes[(k + 1) % 3]);
}

std::map<Side, int> count_sides(const Model& model) {
  std::map<Side, int> count;
  for (const Triangle& triangle : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++count[side_of(triangle, k)];
  }
  return count;
}

}  // namespace

void add_body_force(System& system, const BodyForce& force) {
  for (const Triangle& triangle : system.model.triangles) {
    const double thickness = system.model.plates[to_size(triangle.plate)].thickness;
    Eigen::Matrix<double, 2, 6> forces = Eigen::Matrix<double, 2, 6>::Zero();
    for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
      const TriangleInterpolation at = interpolate(system.model, triangle, point.area_coordinates);
      forces += point.weight * at.area * thickness * force(at.position) * at.N.transpose();
    }
    detail::scatter(system.coordinates.of_triangle<12>(triangle), forces.reshaped(), system.load);
  }
  project(system);
}

void add_edge_traction(System& system, const Traction& traction) {
  const std::map<Side, int> count = count_sides(system.model);
  const SideLoad load = [&traction](const Vector2d& position, const Vector2d& tangent) -> Vector2d {
    const double length = tangent.norm();
    return length * traction(position, Vector2d(tangent.y(), -tangent.x()) / length);
  };
  for (const Triangle& triangle : system.model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (count.at(side_of(triangle, k)) != 1) continue;
      const std::array nodes{triangle.nodes[k], triangle.nodes[(k + 1) % 3], triangle.nodes[k + 3]};
      const auto forces = side_forces(system.model, triangle.plate, nodes, load);
      for (std::size_t i = 0; i < 3; ++i) {
        if (nodes[i] < 0) continue;
        const auto& [x, y, rotation] = system.coordinates.node[to_size(nodes[i])];
        detail::scatter(std::array{x, y}, forces[i], system.load);
      }
    }
  }
  project(system);
}

void add_line_load(System& system, const LineLoad& load) {
  for (const FrameElement& e : system.mesh.frame) {
    if (e.is_bar()) continue;
    const Member& member = system.model.members[static_cast<std::size_t>(e.member)];
    const double phi = shear_ratio(e.section, member.theory, e.length);
    const Matrix6d R = frame_rotation(e.direction);
    const Vector2d& start = system.mesh.positions[static_cast<std::size_t>(e.nodes[0])];
    Vector6d force = Vector6d::Zero();
    for (const LineQuadraturePoint& point : line_quadrature()) {
      Vector3d q = load(start + point.xi * e.length * e.direction);
      q.head<2>() = R.topLeftCorner<2, 2>() * q.head<2>();
      force +=
          point.weight * e.length * frame_interpolation(phi, e.length, point.xi).transpose() * q;
    }
    detail::scatter(e.coordinates, (R.transpose() * force).eval(), system.load);
  }
  project(system);
}

}  // namespace trammel::solver
