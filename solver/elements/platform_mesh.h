#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/model/model.h"

/// The platform's triangles and its pins of finite radius.
namespace trammel::solver {

struct TriangleMesh {
  using Nodes = std::array<Index, 6>;  ///< corners counterclockwise, middles of 01, 12, 20 or -1
  std::vector<Vector2d> nodes;         ///< [m]; the first four are C1, C2, C3, P
  std::vector<Nodes> triangles;
};

/// The paper's three triangles, each split in four `refinements` times, then with nodes at the
/// middles of their sides where six are wanted.
/// @throws ModelError  where P is not inside the triangle, or refinements is not in 0..10.
[[nodiscard]] TriangleMesh platform_mesh(const std::array<Vector2d, 3>& vertices, const Vector2d& P,
                                         int refinements, bool six_nodes = false);

/// How a pin at x0 follows the nodes around it, u(x0) = sum w_i u_i:
///   w_i = int N_i(x) phi(x) (a + b . (x - x0)) dA,  phi = (1 - |x - x0|^2 / radius^2)^3,
/// with a and b such that sum w_i = 1 and sum w_i x_i = x0. The linear factor is what makes the
/// weights carry a moment: a plain mean over the sector at a corner would put the force at the
/// sector's centroid, and a rigid rotation of the plate would then strain the link.
/// Source: the moment-corrected kernel of reproducing-kernel methods (Liu, Jun, Zhang 1995).
/// @throws ModelError  where the pin reaches no triangle.
[[nodiscard]] std::vector<std::pair<Index, double>> pin_weights(const TriangleMesh& mesh,
                                                                const Vector2d& x0, double radius);

}  // namespace trammel::solver
