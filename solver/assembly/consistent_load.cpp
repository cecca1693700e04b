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

const Plate& plate_of(const System& system, const Triangle& triangle) {
  return system.model.plates[static_cast<std::size_t>(triangle.plate)];
}

void add_to_nodes(System& system, const Triangle& triangle, const TriangleInterpolation& at,
                  const Vector2d& force) {
  for (Index i = 0; i < at.nodes; ++i) {
    const auto node = static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i)]);
    const auto& coordinates = system.coordinates.node[node];
    system.load[coordinates[0]] += at.N[i] * force.x();
    system.load[coordinates[1]] += at.N[i] * force.y();
  }
}

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

/// Along the side from corner k to the next, at a fraction of it.
Eigen::Vector3d on_side(std::size_t k, double at) {
  Eigen::Vector3d L = Eigen::Vector3d::Zero();
  L[static_cast<Index>(k)] = 1 - at;
  L[static_cast<Index>((k + 1) % 3)] = at;
  return L;
}

/// d(position) / d(fraction) along the side from corner k to the next.
Vector2d tangent(const Model& model, const Triangle& triangle, std::size_t k, double at) {
  const auto position = [&](std::size_t i) -> const Vector2d& {
    return model.nodes[static_cast<std::size_t>(triangle.nodes[i])].position;
  };
  const auto dN = side_shape(triangle.quadratic(), at).dN;
  Vector2d along = dN[0] * position(k) + dN[1] * position((k + 1) % 3);
  if (triangle.quadratic()) along += dN[2] * position(k + 3);
  return along;
}

}  // namespace

void add_body_force(System& system, const BodyForce& force) {
  for (const Triangle& triangle : system.model.triangles) {
    for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
      const TriangleInterpolation at = interpolate(system.model, triangle, point.area_coordinates);
      const double volume = point.weight * at.area * plate_of(system, triangle).thickness;
      add_to_nodes(system, triangle, at, volume * force(at.position));
    }
  }
  project(system);
}

void add_edge_traction(System& system, const Traction& traction) {
  const std::map<Side, int> count = count_sides(system.model);
  for (const Triangle& triangle : system.model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (count.at(side_of(triangle, k)) != 1) continue;
      for (const LineQuadraturePoint& point : line_quadrature()) {
        const TriangleInterpolation at = interpolate(system.model, triangle, on_side(k, point.xi));
        const Vector2d along = tangent(system.model, triangle, k, point.xi);
        const Vector2d normal = Vector2d(along.y(), -along.x()) / along.norm();
        const double area = point.weight * along.norm() * plate_of(system, triangle).thickness;
        add_to_nodes(system, triangle, at, area * traction(at.position, normal));
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
