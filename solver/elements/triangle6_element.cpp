#include "solver/elements/triangle6_element.h"

#include "solver/elements/triangle_element.h"
#include "solver/elements/triangle_interpolation.h"

namespace trammel::solver {
namespace {

std::array<TriangleQuadraturePoint, 6> degree_4() {
  constexpr double a = 0.44594849091596488631832925388305;
  constexpr double b = 0.09157621350977074345957146340220;
  constexpr double wa = 0.22338158967801146569500700843312;
  constexpr double wb = 0.10995174365532186763832632490021;
  return {{{{1 - 2 * a, a, a}, wa},
           {{a, 1 - 2 * a, a}, wa},
           {{a, a, 1 - 2 * a}, wa},
           {{1 - 2 * b, b, b}, wb},
           {{b, 1 - 2 * b, b}, wb},
           {{b, b, 1 - 2 * b}, wb}}};
}

Eigen::Matrix<double, 3, 12> deformation_of(const TriangleInterpolation& point) {
  Eigen::Matrix<double, 3, 12> B;
  for (Index i = 0; i < 6; ++i) {
    const double dx = point.gradient(0, i);
    const double dy = point.gradient(1, i);
    B.col(2 * i) << dx, dx, dy;
    B.col(2 * i + 1) << dy, -dy, dx;
  }
  return B;
}

const Plate& plate_of(const Model& model, const Triangle& triangle) {
  return model.plates[static_cast<std::size_t>(triangle.plate)];
}

}  // namespace

const std::array<TriangleQuadraturePoint, 6>& triangle6_quadrature() {
  static const std::array<TriangleQuadraturePoint, 6> points = degree_4();
  return points;
}

Triangle6Stiffness triangle6_stiffness(const Model& model, const Triangle& triangle) {
  const Plate& plate = plate_of(model, triangle);
  Triangle6Stiffness k;
  Index row = 0;
  for (const TriangleQuadraturePoint& point : triangle6_quadrature()) {
    const TriangleInterpolation at = interpolate(model, triangle, point.area_coordinates);
    k.deformation.middleRows<3>(row) = deformation_of(at);
    k.rigidity.segment<3>(row) =
        membrane_rigidity(plate.material, point.weight * at.area * plate.thickness);
    row += 3;
  }
  return k;
}

Matrix12d triangle6_mass(const Model& model, const Triangle& triangle) {
  const Plate& plate = plate_of(model, triangle);
  Matrix12d M = Matrix12d::Zero();
  for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
    const TriangleInterpolation at = interpolate(model, triangle, point.area_coordinates);
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

Eigen::Matrix<double, 3, 12> triangle6_deformation_matrix(const Model& model,
                                                          const Triangle& triangle,
                                                          const Eigen::Vector3d& at) {
  return deformation_of(interpolate(model, triangle, at));
}

}  // namespace trammel::solver
