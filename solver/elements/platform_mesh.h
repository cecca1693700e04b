#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/model/model.h"

/// Triangle mesh of the platform of a manipulator, and pins of finite radius at the platform
/// joints.
namespace trammel::solver {

/// Triangle mesh of a platform.
struct TriangleMesh {
  /// Node indices of a triangle: the corners 0, 1, 2 counterclockwise, then the mid-side nodes of
  /// the sides 01, 12, 20. For three-node triangles, the last three indices are -1.
  using Nodes = std::array<Index, 6>;
  std::vector<Vector2d> nodes;  ///< positions of the nodes [m]; the first four are C1, C2, C3, P
  std::vector<Nodes> triangles;
};

/// Meshes a platform with the joints C1, C2, C3 (`vertices`) and the center P. The coarsest mesh
/// consists of the triangles C1 C2 P, C2 C3 P and C3 C1 P, as in Varalakshmi & Srinivas (2017).
/// Each of the `refinements` steps splits every triangle into four triangles. Mid-side nodes are
/// then added if the triangles have six nodes.
/// @throws ModelError  if P is not inside the triangle C1 C2 C3, or refinements is not in 0..10.
[[nodiscard]] TriangleMesh platform_mesh(const std::array<Vector2d, 3>& vertices, const Vector2d& P,
                                         int refinements, bool six_nodes = false);

/// Returns weights w_i [-] that express the displacement of a pin at x0 [m] by the displacements of
/// mesh nodes i. N_i is the shape function of a node, and the radius is that of the pin [m]:
///
///   u(x0) = sum w_i u_i,
///   w_i = int N_i(x) phi(x) (a + b . (x - x0)) dA,
///   phi = (1 - |x - x0|^2 / radius^2)^3.
///
/// The constants a and b satisfy sum w_i = 1 and sum w_i x_i = x0. The factor a + b . (x - x0)
/// makes the pin force act at x0. At a corner of the platform, the plate covers only a sector of
/// the pin. A mean without this factor would apply the pin force at the centroid of the sector. A
/// rigid rotation of the plate would then strain the attached link.
/// Source: moment-corrected kernel of reproducing-kernel methods (Liu, Jun, Zhang 1995).
/// @throws ModelError  if no triangle is within the radius of x0.
[[nodiscard]] std::vector<std::pair<Index, double>> pin_weights(const TriangleMesh& mesh,
                                                                const Vector2d& x0, double radius);

}  // namespace trammel::solver
