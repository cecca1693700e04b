#pragma once

#include <array>
#include <vector>

#include "solver/model/model.h"

namespace trammel::solver {

/// Element of a member: one of its equal parts, between two nodes of the mesh.
struct FrameElement {
  Index member = 0;
  std::array<Index, 2> nodes{};
  /// Unconstrained coordinates (u1 v1 θ1 u2 v2 θ2) in world axes. θ is -1 for a bar without
  /// bending.
  std::array<Index, 6> coordinates{};
  Section section;  ///< at the midpoint of the element
  /// Length [m].
  double length = 0;
  /// Direction of the full member, so that its elements are collinear.
  Vector2d direction = Vector2d::UnitX();
  [[nodiscard]] bool is_bar() const { return coordinates[2] < 0; }
};

/// Nodes and frame elements. The nodes of the model come first, in their order. They are followed
/// by the nodes that divide members into elements.
struct Mesh {
  std::vector<Vector2d> positions;  ///< [m]
  std::vector<FrameElement> frame;  ///< in the order of the members, from first to second node
};

/// Unconstrained coordinates u. They are the translations of every mesh node, the rotations of
/// nodes, and the rotations of released member ends.
///
/// A node has a rotation if at least one of these applies:
///
/// - A welded or sprung member end, a rigid body or a rotational spring is connected to it.
/// - It carries rotary inertia or an offset mass.
/// - A rotational support acts on it and a member ends there.
struct Coordinates {
  Index size = 0;
  std::vector<std::array<Index, 3>> node;        ///< mesh node -> (x, y, rotation or -1)
  std::vector<std::array<Index, 2>> member_end;  ///< member -> rotations of its two ends, or -1
  std::vector<Index> node_of;                    ///< coordinate -> mesh node to which it belongs
  std::vector<bool> is_rotation;                 ///< coordinate -> true for a rotation

  /// Returns (u1 v1 u2 v2 ...) of the first n / 2 nodes of a triangle. Missing nodes have -1.
  template <std::size_t n>
  [[nodiscard]] std::array<Index, n> of_triangle(const Triangle& triangle) const {
    std::array<Index, n> numbers{};
    for (std::size_t i = 0; i < n; ++i)
      numbers[i] = triangle.nodes[i / 2] < 0 ? -1 : node[to_size(triangle.nodes[i / 2])][i % 2];
    return numbers;
  }

  /// Returns the index of a coordinate in u.
  /// @throws ModelError  if the node or member end has no such coordinate.
  [[nodiscard]] Index number(const Model& model, const Coordinate& coordinate) const;
};

/// Mesh and numbering of a model.
struct Discretisation {
  Mesh mesh;
  Coordinates coordinates;
};

/// Divides the members into elements and numbers the coordinates. The model must pass `validate`.
[[nodiscard]] Discretisation discretize(const Model& model);

}  // namespace trammel::solver
