#include "solver/elements/triangle_element.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/model/model.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {

namespace {

/// Returns the derivatives of the shape functions with respect to the area coordinates L_0 and L_1,
/// with L_2 = 1 - L_0 - L_1.
Eigen::Matrix<double, 2, 6> local_gradient(bool six_nodes, const Vector3d& L) {
  Eigen::Matrix<double, 2, 6> d = Eigen::Matrix<double, 2, 6>::Zero();
  if (!six_nodes) {
    d.leftCols<3>() << 1, 0, -1, 0, 1, -1;
    return d;
  }
  d << 4 * L[0] - 1, 0, 1 - 4 * L[2], 4 * L[1], -4 * L[1], 4 * (L[2] - L[0]),  //
      0, 4 * L[1] - 1, 1 - 4 * L[2], 4 * L[0], 4 * (L[2] - L[1]), -4 * L[0];
  return d;
}

}  // namespace

Eigen::Matrix<double, 6, 1> triangle_shape_functions(const Vector3d& L, bool six_nodes) {
  Eigen::Matrix<double, 6, 1> N = Eigen::Matrix<double, 6, 1>::Zero();
  if (six_nodes) {
    N << L[0] * (2 * L[0] - 1), L[1] * (2 * L[1] - 1), L[2] * (2 * L[2] - 1), 4 * L[0] * L[1],
        4 * L[1] * L[2], 4 * L[2] * L[0];
  } else {
    N.head<3>() = L;
  }
  return N;
}

TriangleInterpolation evaluate_shape_functions(std::span<const Vector2d> nodes, const Vector3d& L) {
  TriangleInterpolation result;
  result.nodes = std::ssize(nodes);
  result.N = triangle_shape_functions(L, nodes.size() == 6);
  const Eigen::Matrix<double, 2, 6> local = local_gradient(nodes.size() == 6, L);
  Eigen::Matrix2d J = Eigen::Matrix2d::Zero();  // Jacobian matrix, row i: d(x, y) / dL_i
  for (Index i = 0; i < result.nodes; ++i) {
    const Vector2d& p = nodes[to_size(i)];
    result.position += result.N[i] * p;
    J += local.col(i) * p.transpose();
  }
  result.gradient = J.inverse() * local;
  result.signed_area = J.determinant() / 2;
  result.area = std::abs(result.signed_area);
  return result;
}

TriangleInterpolation evaluate_shape_functions(const Model& model, const Triangle& triangle,
                                               const Vector3d& L) {
  return visit_nodes(model, triangle,
                     [&](const auto& nodes) { return evaluate_shape_functions(nodes, L); });
}

double signed_area(const TrianglePoints& points) {
  return cross(points[1] - points[0], points[2] - points[0]) / 2;
}

Eigen::Matrix<double, 3, 6> triangle_deformation_matrix(const TrianglePoints& points) {
  const double twice = 2 * signed_area(points);
  TriangleInterpolation at;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d edge = points[(i + 2) % 3] - points[(i + 1) % 3];
    at.gradient.col(static_cast<Index>(i)) << -edge.y() / twice, edge.x() / twice;
  }
  return triangle_deformation_matrix<3>(at);
}

Vector3d membrane_rigidity(const Material& material, double volume) {
  const double shear = material.E / (2 * (1 + material.nu));
  return volume * Vector3d(material.E / (2 * (1 - material.nu)), shear, shear);
}

Vector3d membrane_stress(const Material& material, const Vector3d& deformation) {
  const Vector3d force = membrane_rigidity(material, 1).cwiseProduct(deformation);
  return {force[0] + force[1], force[0] - force[1], force[2]};
}

template <>
TriangleStiffness<3> triangle_stiffness(const TrianglePoints& nodes, const Plate& plate) {
  return {triangle_deformation_matrix(nodes),
          membrane_rigidity(plate.material, plate.thickness * std::abs(signed_area(nodes)))};
}

template <>
TriangleStiffness<6> triangle_stiffness(const TriangleNodes<6>& nodes, const Plate& plate) {
  TriangleStiffness<6> k;
  Index row = 0;
  for (const TriangleQuadraturePoint& point : triangle_quadrature_of_degree_4()) {
    const TriangleInterpolation at = evaluate_shape_functions(nodes, point.area_coordinates);
    k.B.middleRows<3>(row) = triangle_deformation_matrix<6>(at);
    k.c.segment<3>(row) =
        membrane_rigidity(plate.material, point.weight * at.area * plate.thickness);
    row += 3;
  }
  return k;
}

template <>
TriangleMatrix<3> triangle_mass(const TrianglePoints& nodes, const Plate& plate) {
  const double m = plate.material.rho * plate.thickness * std::abs(signed_area(nodes)) / 12;
  Matrix6d M = Matrix6d::Zero();
  for (Index i = 0; i < 6; ++i) {
    for (Index j = i % 2; j < 6; j += 2) M(i, j) = i == j ? 2 * m : m;
  }
  return M;
}

template <>
TriangleMatrix<6> triangle_mass(const TriangleNodes<6>& nodes, const Plate& plate) {
  TriangleMatrix<6> M = TriangleMatrix<6>::Zero();
  for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
    const TriangleInterpolation at = evaluate_shape_functions(nodes, point.area_coordinates);
    const double dm = plate.material.rho * plate.thickness * at.area * point.weight;
    for (Index i = 0; i < 6; ++i) {
      for (Index j = 0; j < 6; ++j) {
        M(2 * i, 2 * j) += dm * at.N[i] * at.N[j];
        M(2 * i + 1, 2 * j + 1) += dm * at.N[i] * at.N[j];
      }
    }
  }
  return M;
}

namespace {

/// Shape functions N of the two end nodes and the middle node of a triangle side, and the
/// derivatives dN/ds with respect to the side coordinate 0 <= s <= 1.
struct SideShape {
  std::array<double, 3> N, dN;
};
SideShape side_shape_functions(bool quadratic, double s) {
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
    const auto [N, dN] = side_shape_functions(nodes[2] >= 0, point.xi);
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
