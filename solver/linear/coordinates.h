#pragma once

#include <array>
#include <vector>

#include "solver/model/model.h"

namespace trammel::solver {

/// A member's element: one equal part of it, between two nodes of the mesh.
struct FrameElement {
  Index member = 0;
  std::array<Index, 2> nodes{};
  /// Unconstrained coordinates (u1 v1 θ1 u2 v2 θ2), world axes; θ is -1 in a bar without bending.
  std::array<Index, 6> coordinates{};
  Section section;  ///< at its middle
  double length = 0;
  Vector2d direction = Vector2d::UnitX();  ///< of the whole member, so that its parts are in line
  [[nodiscard]] bool is_bar() const { return coordinates[2] < 0; }
};

/// The model's nodes, in their order, followed by those that cut the members into elements.
struct Mesh {
  std::vector<Vector2d> positions;  ///< [m]
  std::vector<FrameElement> frame;  ///< in the order of the members, first to second node
};

/// The unconstrained coordinates u: translations of every mesh node, rotations of the nodes that
/// have one, and rotations of the member ends that are released from theirs.
///
/// What gives a node its rotation: a welded or sprung member end, a rigid body, a rotational
/// spring, inertia or an offset mass; or a rotational support where a member ends.
struct Coordinates {
  Index size = 0;
  std::vector<std::array<Index, 3>> node;        ///< mesh node -> (x, y, rotation or -1)
  std::vector<std::array<Index, 2>> member_end;  ///< member -> rotations of its ends, or -1
  std::vector<Index> node_of;                    ///< coordinate -> mesh node it moves or turns at
  std::vector<bool> is_rotation;                 ///< coordinate

  /// (u1 v1 u2 v2 ...) of a triangle's first n / 2 nodes; -1 for a node that it does not have.
  template <std::size_t n>
  [[nodiscard]] std::array<Index, n> of_triangle(const Triangle& triangle) const {
    std::array<Index, n> numbers{};
    for (std::size_t i = 0; i < n; ++i)
      numbers[i] = triangle.nodes[i / 2] < 0 ? -1 : node[to_size(triangle.nodes[i / 2])][i % 2];
    return numbers;
  }

  /// Number of a coordinate of the model.
  /// @throws ModelError  naming the node or member end that has no such coordinate.
  [[nodiscard]] Index number(const Model& model, const Coordinate& coordinate) const;
};

struct Discretisation {
  Mesh mesh;
  Coordinates coordinates;
};

/// Cuts the members and numbers the coordinates. The model has passed `validate`.
[[nodiscard]] Discretisation discretise(const Model& model);

}  // namespace trammel::solver
