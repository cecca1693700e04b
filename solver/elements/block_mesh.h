#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/model.h"

/// Mapped meshes of plates. A mesh consists of quadrilateral blocks with straight or elliptic
/// sides, which are joined where their sides coincide. The functions have no side effects except on
/// their arguments.
namespace trammel::solver {

/// Ellipse with axes parallel to x and y:
///
///   `x = center.x + semi_axes.x cos t`,  `y = center.y + semi_axes.y sin t`.
///
/// A side on the ellipse follows the shorter arc between its corners, with nodes at equal steps of
/// t if the grading is 1.
struct Ellipse {
  Vector2d center = Vector2d::Zero();     ///< [m]
  Vector2d semi_axes = Vector2d::Ones();  ///< along x and y [m]
};

/// Quadrilateral block of a mapped mesh.
struct Block {
  std::array<Vector2d, 4> corners;  ///< counterclockwise [m]
  /// Ellipse on which each side lies, or an empty value for a straight side. Side i runs from
  /// corner i to corner i + 1.
  std::array<std::optional<Ellipse>, 4> sides;
  /// Numbers of cells in two directions: along sides 0 and 2, and along sides 1 and 3.
  std::array<Index, 2> cells{1, 1};
  /// Ratio of the length of the last cell to that of the first cell in each direction. The cells
  /// are counted from corner 0.
  std::array<double, 2> grading{1, 1};
};

/// Nodes and triangles of a mesh of blocks.
struct BlockMesh {
  bool six_nodes = false;
  std::vector<Vector2d> positions;  ///< [m]
  /// Indices of the nodes of each triangle, corners counterclockwise, then mid-side nodes; entries
  /// 3 to 5 are -1 for three-node triangles.
  std::vector<std::array<Index, 6>> triangles;
  /// Indices of the nodes along each side of each block, from corner to corner, with mid-side
  /// nodes: sides[block][side].
  std::vector<std::array<std::vector<Index>, 4>> sides;
};

/// Divides each cell of each block into two triangles with alternating diagonals. Inner points
/// follow from transfinite interpolation (Gordon & Hall 1973). This places the middle nodes of
/// six-node triangles on the curved sides. Nodes of different blocks are merged if their distance
/// is below 1e-9 of the mesh size.
/// @throws ModelError  if there is no block, a corner is not on its ellipse, a block has no cells,
///   or a grading is not positive.
[[nodiscard]] BlockMesh mesh_blocks(const std::vector<Block>& blocks, bool six_nodes);

/// Adds the triangles of a mesh to the plate with index `plate` of a model, and new nodes without
/// names. A mesh node is merged with a model node if their distance is below 1e-9 of the mesh size.
/// If several model nodes match, model nodes in `corners` (block corners) have priority, then the
/// first node of the model.
/// @returns the index of the model node for each mesh node.
std::vector<Index> append_mesh(Model& model, Index plate, const BlockMesh& mesh,
                               const std::vector<Index>& corners = {});

// Meshes for verifying orders of convergence. They are regular, or distorted in a pattern that
// repeats after a few cells. Refinement therefore does not smooth out the distortion.

/// Parameters of a triangle mesh of a rectangle with one corner at the origin.
struct RectangleMesh {
  double length = 0;  ///< along x, from the origin [m]
  double height = 0;  ///< along y [m]
  /// Number of cells along each side of the rectangle. Each cell is split into two triangles with
  /// alternating diagonals.
  Index cells = 1;
  bool six_nodes = false;
  double distortion = 0;  ///< displacement of inner corners [cell size]; 0 <= distortion < 0.3
};

/// Returns a model with one plate, meshed by triangles with the given distortion, without supports
/// and loads.
/// @throws ModelError  if the distortion is outside its range and could invert a triangle.
[[nodiscard]] Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate);

/// Parameters of a mesh of members along a straight line.
struct DistortedLine {
  Vector2d start = Vector2d::Zero();  ///< [m]
  Vector2d end = Vector2d::Zero();    ///< [m]
  Index cells = 1;
  double distortion = 0;  ///< displacement of every second inner node [cells]; 0 <= distortion < 1
};

/// Returns a model of the line with one member per cell. Its first node is at the start of the
/// line.
/// @param mesh  geometry of the line and its distortion.
/// @param member  properties of all members; its nodes and number of elements are ignored.
/// @throws ModelError  if the distortion is outside its range and could invert a member.
[[nodiscard]] Model mesh_line(const DistortedLine& mesh, const Member& member);

}  // namespace trammel::solver
