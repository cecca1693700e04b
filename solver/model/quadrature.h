#pragma once

#include <Eigen/Core>
#include <array>

/// Integration rules for what is not a polynomial: loads and errors of fields given as functions.
/// (Element matrices have rules of their own, as long as they must be.)
namespace trammel::solver {

struct LineQuadraturePoint {
  double xi = 0;      ///< fraction of the length
  double weight = 0;  ///< the weights add up to 1
};

/// Gauss-Legendre with five points: exact to degree 9.
[[nodiscard]] const std::array<LineQuadraturePoint, 5>& line_quadrature();

struct TriangleQuadraturePoint {
  Eigen::Vector3d area_coordinates = Eigen::Vector3d::Zero();  ///< area coordinates of the corners
  double weight = 0;                                           ///< the weights add up to 1
};

/// The square of the rule above with one side collapsed to a corner: exact to degree 8.
/// Source: Stroud & Secrest (1966), conical product.
[[nodiscard]] const std::array<TriangleQuadraturePoint, 25>& triangle_quadrature();

/// Exact to degree 4.   Source: Dunavant (1985).
[[nodiscard]] const std::array<TriangleQuadraturePoint, 6>& triangle_quadrature_of_degree_4();

}  // namespace trammel::solver
