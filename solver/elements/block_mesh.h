#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/model.h"

/// Mapped meshes of plates. A mesh consists of quadrilateral blocks with straight or elliptic
/// sides. Blocks are joined along coinciding sides. The functions have no side effects except on
/// their arguments.
namespace trammel::solver {

/// Ellipse with axes parallel to x and y:
///
///   `x = center.x + semi_axes.x cos t`,  `y = center.y + semi_axes.y sin t`.
///
/// A block side on the ellipse follows the shorter arc between its two corners. If the grading is
/// 1, the nodes along the side have equal increments of t.
struct Ellipse {
  Vector2d center = Vector2d::Zero();     ///< center of the ellipse [m]
  Vector2d semi_axes = Vector2d::Ones();  ///< semi-axes along x and y [m]
};

/// Quadrilateral block of a mapped mesh.
struct Block {
  std::array<Vector2d, 4> corners;  ///< corner points in counterclockwise order [m]
  /// Ellipse on which each side of the block lies, or an empty value for a straight side. Side i
  /// runs from corner i to corner i + 1, and side 3 to corner 0.
  std::array<std::optional<Ellipse>, 4> sides;
  /// Numbers of mesh cells of the block along sides 0 and 2, and along sides 1 and 3.
  std::array<Index, 2> cells{1, 1};
  /// Length of the last cell divided by that of the first cell, along sides 0 and 2, and along
  /// sides 1 and 3. The cells are counted from corner 0.
  std::array<double, 2> grading{1, 1};
};

/// Nodes and triangles of a mesh that consists of blocks.
struct BlockMesh {
  bool six_nodes = false;
  std::vector<Vector2d> positions;  ///< positions of the nodes [m]
  /// Node indices of each triangle: the three corners counterclockwise, then the mid-side nodes.
  /// For three-node triangles, the last three indices are -1.
  std::vector<std::array<Index, 6>> triangles;
  /// Indices of the nodes along each side of each block, from corner to corner, including mid-side
  /// nodes: sides[block][side].
  std::vector<std::array<std::vector<Index>, 4>> sides;
};

/// Divides the blocks of a plate into triangles. Each cell of a block is divided into two triangles
/// with alternating diagonals. Inner nodes follow from transfinite interpolation (Gordon & Hall
/// 1973). Mid-side nodes of six-node triangles along a curved side of a block lie on the curve.
/// Nodes of different blocks are merged if their distance is below 1e-9 times the diagonal of the
/// bounding box of the mesh.
/// @throws ModelError  if there is no block, a corner is not on the ellipse of an adjacent side, a
///   block has no cells, or a grading is not positive.
[[nodiscard]] BlockMesh mesh_blocks(const std::vector<Block>& blocks, bool six_nodes);

/// Adds the triangles of a mesh to the plate with index `plate` of a model. A mesh node is merged
/// with a model node if their distance is below 1e-9 times the diagonal of the bounding box of the
/// mesh. If several model nodes match, model nodes in `corners` (block corners) have priority, then
/// the first node of the model. If no model node matches, a node without name is added to the
/// model.
/// @returns the index of the model node for each mesh node.
std::vector<Index> append_mesh(Model& model, Index plate, const BlockMesh& mesh,
                               const std::vector<Index>& corners = {});

// Meshes for verifying orders of convergence. The meshes are regular, or distorted in a pattern
// that repeats after a few cells. Refinement therefore does not smooth out the distortion.

/// Parameters of a triangle mesh of a rectangle with one corner at the origin.
struct RectangleMesh {
  double length = 0;  ///< length along x, from the origin [m]
  double height = 0;  ///< height along y, from the origin [m]
  /// Number of cells along each side of the rectangle. Each cell is split into two triangles with
  /// alternating diagonals.
  Index cells = 1;
  bool six_nodes = false;
  /// Displacement of the cell corners inside the rectangle [cell size], at least 0, below 0.3.
  double distortion = 0;
};

/// Returns a model of one rectangular plate, which is meshed by triangles. The model has no
/// supports and no loads.
/// @throws ModelError  if the distortion is outside 0 <= distortion < 0.3, so that it could invert
///   a triangle.
[[nodiscard]] Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate);

/// Parameters of a mesh of members along a straight line.
struct DistortedLine {
  Vector2d start = Vector2d::Zero();  ///< start point of the line [m]
  Vector2d end = Vector2d::Zero();    ///< end point of the line [m]
  Index cells = 1;
  /// Displacement of every second inner node along the line [cell length], at least 0, below 1.
  double distortion = 0;
};

/// Returns a model of a straight line of members, with one member per cell. The first node of the
/// model is at the start of the line.
/// @param mesh  end points of the line, number of cells, and distortion of the mesh.
/// @param member  properties of all members; `name`, `nodes` and `elements` are ignored.
/// @throws ModelError  if the distortion is outside 0 <= distortion < 1, so that it could invert a
///   member.
[[nodiscard]] Model mesh_line(const DistortedLine& mesh, const Member& member);

}  // namespace trammel::solver
