#include "solver/elements/triangle_element.h"

#include <cmath>

#include "solver/model/plane.h"

namespace trammel::solver {

TrianglePoints corners(const Model& model, const Triangle& triangle) {
  TrianglePoints points;
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = model.nodes[static_cast<std::size_t>(triangle.nodes[i])].position;
  }
  return points;
}

double signed_area(const TrianglePoints& points) {
  return cross(points[1] - points[0], points[2] - points[0]) / 2;
}

TriangleDeformation triangle_deformation(const TrianglePoints& points) {
  const double twice = 2 * signed_area(points);
  TriangleDeformation B;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d edge = points[(i + 2) % 3] - points[(i + 1) % 3];
    const double dx = -edge.y() / twice;  // dN_i/dx
    const double dy = edge.x() / twice;
    B.col(static_cast<Index>(2 * i)) << dx, dx, dy;
    B.col(static_cast<Index>(2 * i + 1)) << dy, -dy, dx;
  }
  return B;
}

Vector3d membrane_rigidity(const Material& material, double volume) {
  const double shear = material.E / (2 * (1 + material.nu));
  return volume * Vector3d(material.E / (2 * (1 - material.nu)), shear, shear);
}

Vector3d membrane_stress(const Material& material, const Vector3d& deformation) {
  const Vector3d force = membrane_rigidity(material, 1).cwiseProduct(deformation);
  return {force[0] + force[1], force[0] - force[1], force[2]};
}

Matrix6d triangle_stiffness(const TrianglePoints& points, const Plate& plate) {
  const TriangleDeformation B = triangle_deformation(points);
  const double volume = plate.thickness * std::abs(signed_area(points));
  return B.transpose() * membrane_rigidity(plate.material, volume).asDiagonal() * B;
}

Matrix6d triangle_mass(const TrianglePoints& points, const Plate& plate) {
  const double m = plate.material.rho * plate.thickness * std::abs(signed_area(points)) / 12;
  Matrix6d M = Matrix6d::Zero();
  for (Index i = 0; i < 6; ++i) {
    for (Index j = i % 2; j < 6; j += 2) M(i, j) = i == j ? 2 * m : m;
  }
  return M;
}

}  // namespace trammel::solver
