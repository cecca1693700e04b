#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/model/model.h"

/// Triangle mesh of the platform and its pins of finite radius.
namespace trammel::solver {

/// Triangles and nodes of a platform.
struct TriangleMesh {
  /// Corners of a triangle counterclockwise, then its mid-side nodes 01, 12, 20 or -1.
  using Nodes = std::array<Index, 6>;
  std::vector<Vector2d> nodes;  ///< [m]; the first four are C1, C2, C3, P
  std::vector<Nodes> triangles;
};

/// Meshes a platform with the joints C1, C2, C3 (`vertices`) and the center P. The coarsest mesh
/// consists of the triangles C1 C2 P, C2 C3 P and C3 C1 P, as in Varalakshmi & Srinivas (2017).
/// Each triangle is split into four `refinements` times. Mid-side nodes are then added for six-node
/// triangles.
/// @throws ModelError  if P is not inside the triangle C1 C2 C3, or refinements is not in 0..10.
[[nodiscard]] TriangleMesh platform_mesh(const std::array<Vector2d, 3>& vertices, const Vector2d& P,
                                         int refinements, bool six_nodes = false);

/// Returns weights w_i [-] that express the displacement of a pin at x0 [m] by the mesh nodes i
/// within the radius of the pin [m]:
///
///   u(x0) = sum w_i u_i,
///   w_i = int N_i(x) phi(x) (a + b . (x - x0)) dA,
///   phi = (1 - |x - x0|^2 / radius^2)^3.
///
/// The constants a and b satisfy sum w_i = 1 and sum w_i x_i = x0. The linear factor makes the
/// weights transmit a moment correctly. A plain mean over the sector at a corner would move the
/// force to the centroid of the sector. A rigid rotation of the plate would then strain the link.
/// Source: moment-corrected kernel of reproducing-kernel methods (Liu, Jun, Zhang 1995).
/// @throws ModelError  if no triangle is within the radius.
[[nodiscard]] std::vector<std::pair<Index, double>> pin_weights(const TriangleMesh& mesh,
                                                                const Vector2d& x0, double radius);

}  // namespace trammel::solver
