#pragma once

#include <Eigen/Core>
#include <array>

/// Integration rules on lines and triangles. The rules are used for element matrices, and for
/// functions that are not polynomials, such as given distributed loads and errors of fields.
namespace trammel::solver {

/// Point of an integration rule on the line 0 <= xi <= 1.
struct LineQuadraturePoint {
  double xi = 0;      ///< position as a fraction of the length
  double weight = 0;  ///< weight; the sum of all weights is 1
};

/// Returns the five-point Gauss-Legendre rule. It is exact for polynomials up to degree 9.
[[nodiscard]] const std::array<LineQuadraturePoint, 5>& line_quadrature();

/// Point of an integration rule on a triangle.
struct TriangleQuadraturePoint {
  /// Area coordinates of the integration point, one for each corner of the triangle [-].
  Eigen::Vector3d area_coordinates = Eigen::Vector3d::Zero();
  double weight = 0;  ///< weight; the sum of all weights is 1
};

/// Returns the product of two five-point Gauss rules on a square, of which one side is collapsed to
/// a corner of the triangle. The rule is exact for polynomials up to degree 8.
/// Source: Stroud & Secrest (1966), conical product.
[[nodiscard]] const std::array<TriangleQuadraturePoint, 25>& triangle_quadrature();

/// Returns a six-point rule on a triangle. It is exact for polynomials up to degree 4.
/// Source: Dunavant (1985).
[[nodiscard]] const std::array<TriangleQuadraturePoint, 6>& triangle_quadrature_of_degree_4();

}  // namespace trammel::solver
