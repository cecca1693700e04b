#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"
#include "solver/model/quadrature.h"

/// Triangles in plane stress, as pure functions: the constant-strain triangle with three nodes and
/// the isoparametric triangle with six nodes. The mid-side nodes 01, 12, 20 of the latter may lie
/// off the straight line. Coordinates are (u1 v1 u2 v2 ...) in world axes [m].
///
/// The stiffness is diagonal in suitable measures of deformation, as for the frame element:
///
///   d = B u = (exx + eyy, exx - eyy, gxy),
///   k = B^T diag(t A E / (2 (1 - nu)), t A G, t A G) B.
///
/// This equals k = t integral B^T D B dA with the elasticity matrix D, Varalakshmi & Srinivas
/// (2017), Eq. 8. The six-node triangle sums over the points of an integration rule that is exact
/// to degree 4. Its strains are linear, so that degree 2 suffices for straight sides. Curved sides
/// require the higher degree.
namespace trammel::solver {

template <std::size_t n>
using TriangleNodes = std::array<Vector2d, n>;  ///< n = 3 or 6 [m]
using TrianglePoints = TriangleNodes<3>;
template <std::size_t n>
using TriangleMatrix = Eigen::Matrix<double, static_cast<int>(2 * n), static_cast<int>(2 * n)>;

/// Shape functions of a triangle at one point. With three nodes they are the area coordinates L_i.
/// With six nodes they are L_i (2 L_i - 1) at the corners and 4 L_i L_j at the mid-side nodes.
/// Entries beyond the number of nodes are 0.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1.
struct TriangleInterpolation {
  Index nodes = 3;                       ///< 3 or 6
  Eigen::Matrix<double, 6, 1> N;         ///< values [-]
  Eigen::Matrix<double, 2, 6> gradient;  ///< dN/dx, dN/dy [1/m]
  Vector2d position = Vector2d::Zero();  ///< world axes [m]
  /// Half the Jacobian determinant [m^2]; positive if the corners run counterclockwise.
  double signed_area = 0;
  double area = 0;  ///< absolute value of `signed_area` [m^2]
};

/// Returns the area coordinates of the corners and mid-side nodes of a triangle.
[[nodiscard]] inline std::array<Vector3d, 6> triangle_node_area_coordinates() {
  return {Vector3d(1, 0, 0),     Vector3d(0, 1, 0),     Vector3d(0, 0, 1),
          Vector3d(0.5, 0.5, 0), Vector3d(0, 0.5, 0.5), Vector3d(0.5, 0, 0.5)};
}

/// Returns the values of the shape functions [-] at the area coordinates L. Entries beyond the
/// number of nodes are 0.
[[nodiscard]] Eigen::Matrix<double, 6, 1> triangle_shape_functions(const Vector3d& L,
                                                                   bool six_nodes);

/// Evaluates the shape functions of a triangle with 3 or 6 nodes [m] at the area coordinates `L`.
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

/// Calls visit(positions) with the positions of all nodes of the triangle, three or six.
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

/// Stiffness of a triangle in factored form, k = B^T diag(c) B, with three rows per integration
/// point.
template <std::size_t n>
struct TriangleStiffness {
  static constexpr int kRows = n == 3 ? 3 : 18;
  /// Matrix from nodal displacements to deformations (exx + eyy, exx - eyy, gxy) [1/m]. It has
  /// three rows for each integration point.
  Eigen::Matrix<double, kRows, static_cast<int>(2 * n)> B;
  Eigen::Matrix<double, kRows, 1> c;  ///< [N m]
};

/// Computes the factors B and c of the stiffness matrix of a triangle.
/// Source: Varalakshmi & Srinivas (2017), Eq. 8; Zienkiewicz & Taylor.
template <std::size_t n>
[[nodiscard]] TriangleStiffness<n> triangle_stiffness(const TriangleNodes<n>& nodes,
                                                      const Plate& plate);

/// Computes the consistent mass matrix of a triangle [kg], 2n x 2n:
///
///   \f[ m = \rho t \int N^T N \, dA. \f]
///
/// It is also exact for curved sides (integrand of degree 6).
/// Source: Varalakshmi & Srinivas (2017), Eq. 9.
template <std::size_t n>
[[nodiscard]] TriangleMatrix<n> triangle_mass(const TriangleNodes<n>& nodes, const Plate& plate);

/// Function that returns the force per area [Pa] times |dx/ds| [m] at a position [m] on a side with
/// tangent dx/ds [m].
using SideLoad = std::function<Vector2d(const Vector2d& position, const Vector2d& tangent)>;

/// Returns the consistent nodal forces [N] of a loaded side of a plate:
///
///   t integral N^T load ds over 0 <= s <= 1.
///
/// The third force is zero if the side has no middle node (nodes[2] = -1). The side may be curved:
/// it is the parabola through its nodes.
[[nodiscard]] std::array<Vector2d, 3> side_forces(const Model& model, Index plate,
                                                  const std::array<Index, 3>& nodes,
                                                  const SideLoad& load);

/// Returns the consistent nodal forces [N] of a uniform traction on a side of a triangle. The
/// component `normal` acts along the normal of the side.
[[nodiscard]] std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load);

}  // namespace trammel::solver
