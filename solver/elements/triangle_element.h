#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"
#include "solver/model/quadrature.h"

/// Triangles in plane stress, as pure functions: the constant-strain triangle with three nodes and
/// the isoparametric triangle with six nodes. The mid-side nodes 01, 12, 20 of a six-node triangle
/// may lie off the straight side. The degrees of freedom are the nodal displacements (u1 v1 u2 v2
/// ...) in world axes [m].
///
/// As for the frame element, the stiffness is diagonal in suitable measures of deformation d. For a
/// plate of thickness t, triangle area A, Young's modulus E, shear modulus G and Poisson's ratio
/// nu:
///
///   d = B u = (exx + eyy, exx - eyy, gxy),
///   k = B^T diag(t A E / (2 (1 - nu)), t A G, t A G) B.
///
/// This matrix k equals t integral B^T D B dA with the elasticity matrix D, Varalakshmi & Srinivas
/// (2017), Eq. 8. For the six-node triangle, k is a sum over the points of an integration rule that
/// is exact to degree 4. Degree 2 would suffice for straight sides, because the strains are then
/// linear. Curved sides require the higher degree.
namespace trammel::solver {

template <std::size_t n>
using TriangleNodes = std::array<Vector2d, n>;  ///< positions of n = 3 or n = 6 nodes [m]
using TrianglePoints = TriangleNodes<3>;
template <std::size_t n>
using TriangleMatrix = Eigen::Matrix<double, static_cast<int>(2 * n), static_cast<int>(2 * n)>;

/// Shape functions of a triangle at one point. For three nodes, the shape functions are the area
/// coordinates L_i. For six nodes, they are L_i (2 L_i - 1) at the corners and 4 L_i L_j at the
/// mid-side nodes. For three nodes, the last three values and gradients are 0.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1.
struct TriangleInterpolation {
  Index nodes = 3;                       ///< number of nodes, 3 or 6
  Eigen::Matrix<double, 6, 1> N;         ///< values of the shape functions [-]
  Eigen::Matrix<double, 2, 6> gradient;  ///< derivatives dN/dx, dN/dy [1/m]
  Vector2d position = Vector2d::Zero();  ///< position of the point in world axes [m]
  /// Half of the Jacobian determinant [m^2]. It is positive if the corners run counterclockwise.
  double signed_area = 0;
  double area = 0;  ///< absolute value of `signed_area` [m^2]
};

/// Returns the area coordinates of the corners and mid-side nodes of a triangle.
[[nodiscard]] inline std::array<Vector3d, 6> triangle_node_area_coordinates() {
  return {Vector3d(1, 0, 0),     Vector3d(0, 1, 0),     Vector3d(0, 0, 1),
          Vector3d(0.5, 0.5, 0), Vector3d(0, 0.5, 0.5), Vector3d(0.5, 0, 0.5)};
}

/// Returns the values of the shape functions of a triangle [-] at the area coordinates L. For a
/// three-node triangle, the last three values are 0.
[[nodiscard]] Eigen::Matrix<double, 6, 1> triangle_shape_functions(const Vector3d& L,
                                                                   bool six_nodes);

/// Evaluates the shape functions of a triangle at the area coordinates `L`. `nodes` contains the
/// positions of the 3 or 6 nodes [m].
[[nodiscard]] TriangleInterpolation evaluate_shape_functions(std::span<const Vector2d> nodes,
                                                             const Vector3d& L);
/// Evaluates the shape functions of a triangle of a model at the area coordinates `L`.
[[nodiscard]] TriangleInterpolation evaluate_shape_functions(const Model& model,
                                                             const Triangle& triangle,
                                                             const Vector3d& L);

/// Returns the positions of the first n nodes of a triangle [m].
template <std::size_t n>
[[nodiscard]] TriangleNodes<n> triangle_nodes(const Model& model, const Triangle& triangle) {
  TriangleNodes<n> points;
  for (std::size_t i = 0; i < n; ++i) points[i] = model.nodes[to_size(triangle.nodes[i])].position;
  return points;
}

/// Calls visit(positions) with the positions of the three or six nodes of a triangle [m].
template <class Visit>
decltype(auto) visit_nodes(const Model& model, const Triangle& triangle, Visit&& visit) {
  return triangle.quadratic() ? visit(triangle_nodes<6>(model, triangle))
                              : visit(triangle_nodes<3>(model, triangle));
}

/// Returns the area of a triangle [m^2], positive if its points run counterclockwise.
[[nodiscard]] double signed_area(const TrianglePoints& points);

/// Returns the deformation matrix B at a point of a triangle. B maps the nodal displacements to the
/// deformations (exx + eyy, exx - eyy, gxy) [-].
template <int nodes>
[[nodiscard]] Eigen::Matrix<double, 3, 2 * nodes> triangle_deformation_matrix(
    const TriangleInterpolation& at) {
  Eigen::Matrix<double, 3, 2 * nodes> B;
  for (Index i = 0; i < nodes; ++i) {
    const double dx = at.gradient(0, i), dy = at.gradient(1, i);
    B.col(2 * i) << dx, dx, dy;
    B.col(2 * i + 1) << dy, -dy, dx;
  }
  return B;
}

/// Returns the deformation matrix B of a three-node triangle, in which the deformation is uniform.
[[nodiscard]] Eigen::Matrix<double, 3, 6> triangle_deformation_matrix(const TrianglePoints& points);

/// Returns the diagonal of the stiffness matrix [N m] with respect to the deformations (exx + eyy,
/// exx - eyy, gxy), for plate material of the given volume [m^3].
[[nodiscard]] Vector3d membrane_rigidity(const Material& material, double volume);

/// Returns the stresses (sxx, syy, sxy) [Pa] of the deformation (exx + eyy, exx - eyy, gxy).
/// Source: Varalakshmi & Srinivas (2017), Eq. 8.
[[nodiscard]] Vector3d membrane_stress(const Material& material, const Vector3d& deformation);

/// Stiffness matrix of a triangle in factored form, k = B^T diag(c) B.
template <std::size_t n>
struct TriangleStiffness {
  static constexpr int kRows = n == 3 ? 3 : 18;
  /// Matrix from nodal displacements to deformations (exx + eyy, exx - eyy, gxy) [1/m]. It has
  /// three rows for each integration point.
  Eigen::Matrix<double, kRows, static_cast<int>(2 * n)> B;
  Eigen::Matrix<double, kRows, 1> c;  ///< rigidity of each deformation [N m]
};

/// Computes the factors B and c of the stiffness matrix k = B^T diag(c) B of a triangle.
/// Source: Varalakshmi & Srinivas (2017), Eq. 8; Zienkiewicz & Taylor.
template <std::size_t n>
[[nodiscard]] TriangleStiffness<n> triangle_stiffness(const TriangleNodes<n>& nodes,
                                                      const Plate& plate);

/// Computes the consistent mass matrix of a triangle [kg], 2n x 2n:
///
///   \f[ m = \rho t \int N^T N \, dA. \f]
///
/// The integration is exact also for curved sides, for which the integrand has degree 6.
/// Source: Varalakshmi & Srinivas (2017), Eq. 9.
template <std::size_t n>
[[nodiscard]] TriangleMatrix<n> triangle_mass(const TriangleNodes<n>& nodes, const Plate& plate);

/// Function that returns the force per area [Pa] times |dx/ds| [m] at a position x [m] on a
/// triangle side. `tangent` is dx/ds [m] with the side coordinate s.
using SideLoad = std::function<Vector2d(const Vector2d& position, const Vector2d& tangent)>;

/// Returns the consistent nodal forces [N] of a loaded side of a plate with thickness t and shape
/// functions N:
///
///   t integral N^T load ds over 0 <= s <= 1.
///
/// The third force is zero if the side has no middle node (nodes[2] = -1). A side with a middle
/// node is the parabola through its three nodes.
[[nodiscard]] std::array<Vector2d, 3> side_forces(const Model& model, Index plate,
                                                  const std::array<Index, 3>& nodes,
                                                  const SideLoad& load);

/// Returns the consistent nodal forces [N] of a uniform traction on a side of a triangle. The
/// component `normal` acts along the normal of the side.
[[nodiscard]] std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load);

}  // namespace trammel::solver
