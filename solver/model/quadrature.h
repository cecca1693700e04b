#pragma once

#include <Eigen/Core>
#include <array>

/// Integration rules for integrands that are not polynomials: loads and errors of fields given as
/// functions. Element matrices use rules of the degree that they require.
namespace trammel::solver {

/// Point of a rule on 0 <= xi <= 1.
struct LineQuadraturePoint {
  double xi = 0;      ///< fraction of the length
  double weight = 0;  ///< the weights sum to 1
};

/// Returns the five-point Gauss-Legendre rule, exact to degree 9.
[[nodiscard]] const std::array<LineQuadraturePoint, 5>& line_quadrature();

/// Point of a rule on a triangle.
struct TriangleQuadraturePoint {
  /// Area coordinates of the corners [-].
  Eigen::Vector3d area_coordinates = Eigen::Vector3d::Zero();
  double weight = 0;  ///< the weights sum to 1
};

/// Returns the product of two five-point rules with one side of the square collapsed to a corner.
/// The rule is exact to degree 8.
/// Source: Stroud & Secrest (1966), conical product.
[[nodiscard]] const std::array<TriangleQuadraturePoint, 25>& triangle_quadrature();

/// Returns a six-point rule, exact to degree 4.
/// Source: Dunavant (1985).
[[nodiscard]] const std::array<TriangleQuadraturePoint, 6>& triangle_quadrature_of_degree_4();

}  // namespace trammel::solver
