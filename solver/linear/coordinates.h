#pragma once

#include <array>
#include <vector>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"

namespace trammel::solver {

/// Finite element of a member, between two nodes of the mesh. All elements of a member have equal
/// lengths.
struct FrameElement {
  Index member = 0;
  std::array<Index, 2> nodes{};
  /// Indices of the end displacements (u1 v1 θ1 u2 v2 θ2) in the vector of unconstrained
  /// coordinates, in world axes. The indices of both rotations are -1 for a bar, which does not
  /// bend.
  std::array<Index, 6> coordinates{};
  Section section;  ///< cross section at the midpoint of the element
  /// Length of the element [m].
  double length = 0;
  /// Unit vector along the member. All elements of a member have the same direction and are exactly
  /// collinear.
  Vector2d direction = Vector2d::UnitX();
  /// Mass matrix for `coordinates`, in world axes [kg, kg m, kg m^2]. It belongs to `section`; use
  /// `world_mass_matrix` for another section.
  Matrix6d mass = Matrix6d::Zero();
  [[nodiscard]] bool is_bar() const { return coordinates[2] < 0; }
};

/// Nodes and frame elements of a discretized model. The first nodes are those of the model, in the
/// order of the model. The nodes that divide members into elements follow.
struct Mesh {
  /// Positions of the nodes [m].
  std::vector<Vector2d> positions;
  /// Elements, in the order of the members, from first to second node.
  std::vector<FrameElement> frame;
};

/// Numbering of the unconstrained coordinates u: the translations of every mesh node, the rotations
/// of nodes, and the rotations of released member ends.
///
/// A node that divides a member has a rotation. A node of the model has a rotation if at least one
/// of these conditions is satisfied:
///
/// - A welded or sprung member end or a rotational spring is connected to the node.
/// - The node is the reference node of a rigid body.
/// - The node carries rotary inertia or an offset mass.
/// - The node is attached to a rigid body, and a moment acts on the node.
/// - A support fixes the rotation, and a member or a rigid body is connected to the node.
struct Coordinates {
  Index size = 0;
  std::vector<std::array<Index, 3>> node;        ///< mesh node -> indices (x, y, rotation or -1)
  std::vector<std::array<Index, 2>> member_end;  ///< member -> indices of its end rotations, or -1
  std::vector<Index> node_of;                    ///< index in u -> mesh node of this coordinate
  std::vector<bool> is_rotation;                 ///< index in u -> true for a rotation

  /// Returns the indices of the translations (u1 v1 u2 v2 ...) of the first n / 2 nodes of a
  /// triangle. The indices refer to the vector of unconstrained coordinates. The indices of a
  /// missing mid-side node are -1.
  template <std::size_t n>
  [[nodiscard]] std::array<Index, n> triangle_dofs(const Triangle& triangle) const {
    std::array<Index, n> numbers{};
    for (std::size_t i = 0; i < n; ++i)
      numbers[i] = triangle.nodes[i / 2] < 0 ? -1 : node[to_size(triangle.nodes[i / 2])][i % 2];
    return numbers;
  }

  /// Returns the index of a node translation, node rotation or member end rotation in the vector u
  /// of unconstrained coordinates.
  /// @throws ModelError  if the node or member end does not have the coordinate.
  [[nodiscard]] Index index_of(const Model& model, const Coordinate& coordinate) const;
};

struct Discretisation {
  Mesh mesh;
  Coordinates coordinates;
};

/// Divides the members of a model into elements with their mass matrices, and numbers the
/// unconstrained coordinates. The model must pass `validate`.
[[nodiscard]] Discretisation discretize(const Model& model);

}  // namespace trammel::solver
