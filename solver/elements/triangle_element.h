#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"
#include "solver/model/quadrature.h"

/// Triangles in plane stress, as pure functions: the constant-strain triangle of three nodes, and
/// the isoparametric one of six, whose middle nodes of the sides 01, 12, 20 may lie off the
/// straight line. Coordinates (u1 v1 u2 v2 ...) in world axes [m].
///
/// As for the frame element, the stiffness is diagonal in the right measures of deformation,
/// d = B u = (exx + eyy, exx - eyy, gxy): k = B^T diag(t A E / (2 (1 - nu)), t A G, t A G) B,
/// which is the paper's k = t integral B^T D B dA, Eq. (8); with six nodes at each point of a rule
/// that is exact to degree 4: the strains are linear, so that the rule is exact for straight sides
/// and has room for curved ones.
namespace trammel::solver {

template <std::size_t n>
using TriangleNodes = std::array<Vector2d, n>;  ///< n = 3 or 6 [m]
using TrianglePoints = TriangleNodes<3>;
template <std::size_t n>
using TriangleMatrix = Eigen::Matrix<double, static_cast<int>(2 * n), static_cast<int>(2 * n)>;

/// The shape functions at one point: L_i of three nodes; of six L_i (2 L_i - 1) at the corners,
/// 4 L_i L_j at the middles of the sides. Entries beyond the nodes are 0.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1.
struct TriangleInterpolation {
  Index nodes = 3;                       ///< 3 or 6
  Eigen::Matrix<double, 6, 1> N;         ///< values [-]
  Eigen::Matrix<double, 2, 6> gradient;  ///< dN/dx, dN/dy [1/m]
  Vector2d position = Vector2d::Zero();  ///< world [m]
  double signed_area = 0;  ///< [m^2], positive when the corners run counterclockwise here
  double area = 0;         ///< the triangle's area if all of it were like here [m^2]
};

/// Area coordinates of the corners and the middles of the sides.
[[nodiscard]] inline std::array<Vector3d, 6> triangle_node_coordinates() {
  return {Vector3d(1, 0, 0),     Vector3d(0, 1, 0),     Vector3d(0, 0, 1),
          Vector3d(0.5, 0.5, 0), Vector3d(0, 0.5, 0.5), Vector3d(0.5, 0, 0.5)};
}

[[nodiscard]] Eigen::Matrix<double, 6, 1> triangle_shape_functions(const Vector3d& L,
                                                                   bool six_nodes);

/// @param nodes  3 or 6 [m];  @param at  area coordinates L_0, L_1, L_2 of the corners, sum 1
[[nodiscard]] TriangleInterpolation interpolate(std::span<const Vector2d> nodes,
                                                const Vector3d& at);
[[nodiscard]] TriangleInterpolation interpolate(const Model& model, const Triangle& triangle,
                                                const Vector3d& at);

template <std::size_t n>
[[nodiscard]] TriangleNodes<n> triangle_nodes(const Model& model, const Triangle& triangle) {
  TriangleNodes<n> points;
  for (std::size_t i = 0; i < n; ++i) points[i] = model.nodes[to_size(triangle.nodes[i])].position;
  return points;
}

/// visit(all its nodes), three or six.
template <class Visit>
decltype(auto) visit_nodes(const Model& model, const Triangle& triangle, Visit&& visit) {
  return triangle.quadratic() ? visit(triangle_nodes<6>(model, triangle))
                              : visit(triangle_nodes<3>(model, triangle));
}

/// Area [m^2], positive when the points run counterclockwise.
[[nodiscard]] double signed_area(const TrianglePoints& points);

/// B: coordinates -> (exx + eyy, exx - eyy, gxy) [-], at a point.
template <int nodes>
[[nodiscard]] Eigen::Matrix<double, 3, 2 * nodes> triangle_deformation(
    const TriangleInterpolation& at) {
  Eigen::Matrix<double, 3, 2 * nodes> B;
  for (Index i = 0; i < nodes; ++i) {
    const double dx = at.gradient(0, i), dy = at.gradient(1, i);
    B.col(2 * i) << dx, dx, dy;
    B.col(2 * i + 1) << dy, -dy, dx;
  }
  return B;
}

/// The same of three nodes, where it is the same everywhere.
[[nodiscard]] Eigen::Matrix<double, 3, 6> triangle_deformation(const TrianglePoints& points);

/// Diagonal stiffness of the three deformations over a volume [m^3] of plate: [N m].
[[nodiscard]] Vector3d membrane_rigidity(const Material& material, double volume);

/// (sxx, syy, sxy) [Pa] of the three deformations in plane stress.   Source: paper Eq. (8).
[[nodiscard]] Vector3d membrane_stress(const Material& material, const Vector3d& deformation);

/// The stiffness in factors, k = B^T diag(c) B, with three rows for each point of the rule.
template <std::size_t n>
struct TriangleStiffness {
  static constexpr int kRows = n == 3 ? 3 : 18;
  Eigen::Matrix<double, kRows, static_cast<int>(2 * n)> B;  ///< deformations at the points [-]
  Eigen::Matrix<double, kRows, 1> c;                        ///< [N m]
};

/// Source: paper Eq. (8); Zienkiewicz & Taylor.
template <std::size_t n>
[[nodiscard]] TriangleStiffness<n> triangle_stiffness(const TriangleNodes<n>& nodes,
                                                      const Plate& plate);

/// Consistent mass, m = rho t integral N^T N dA, exact for curved sides as well (degree 6).
/// Source: paper Eq. (9).
template <std::size_t n>
[[nodiscard]] TriangleMatrix<n> triangle_mass(const TriangleNodes<n>& nodes, const Plate& plate);

/// Force per area [Pa] times |dx/ds| at a position [m] on a side with tangent dx/ds.
using SideLoad = std::function<Vector2d(const Vector2d& position, const Vector2d& tangent)>;

/// Consistent forces [N] on the nodes of a loaded side of a plate, t integral N^T load ds over
/// 0 <= s <= 1; the third is zero where the side has no middle node (-1). The side may be curved:
/// it is the parabola through its nodes.
[[nodiscard]] std::array<Vector2d, 3> side_forces(const Model& model, Index plate,
                                                  const std::array<Index, 3>& nodes,
                                                  const SideLoad& load);

/// The same of a uniform load, whose pressure follows the normal.
[[nodiscard]] std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load);

}  // namespace trammel::solver
