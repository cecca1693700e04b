#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/model.h"

/// Mapped meshes of plates: quadrilateral blocks with straight or elliptic sides, joined where
/// their sides coincide. Pure functions; the result is nodes and triangles of a Model.
namespace trammel::solver {

/// x = centre.x + semi_axes.x cos t, y = centre.y + semi_axes.y sin t. A side on it runs the
/// shorter way, at even steps of t.
struct Ellipse {
  Vector2d centre = Vector2d::Zero();     ///< [m]
  Vector2d semi_axes = Vector2d::Ones();  ///< along x and y [m]
};

struct Block {
  std::array<Vector2d, 4> corners;              ///< counterclockwise [m]
  std::array<std::optional<Ellipse>, 4> sides;  ///< side i from corner i to i + 1; empty: straight
  std::array<Index, 2> cells{1, 1};             ///< along sides 0 and 2, along sides 1 and 3
  std::array<double, 2> grading{1, 1};          ///< last cell over first, from corner 0
};

struct BlockMesh {
  bool six_nodes = false;
  std::vector<Vector2d> positions;              ///< [m]
  std::vector<std::array<Index, 6>> triangles;  ///< counterclockwise; -1 behind three nodes
  /// block -> side -> its nodes from corner to corner, middles included
  std::vector<std::array<std::vector<Index>, 4>> sides;
};

/// Each cell becomes two triangles, with diagonals that alternate; inner points by transfinite
/// interpolation (Gordon & Hall 1973), which puts the middle nodes of six-node triangles on the
/// curves. Nodes of different blocks within 1e-9 of the mesh's size of one another are one node.
/// @throws ModelError  for a corner that is not on its ellipse, or a block without cells.
[[nodiscard]] BlockMesh mesh_blocks(const std::vector<Block>& blocks, bool six_nodes);

/// Adds the triangles, and those nodes that do not stand in the model yet, without names: where the
/// model has a node within 1e-9 of the mesh's size, the mesh is joined to it (of several to a
/// corner, else to the first).
/// @param corners  the model's nodes that the blocks were made of
/// @returns the model's node of each of the mesh's
std::vector<Index> append(Model& model, Index plate, const BlockMesh& mesh,
                          const std::vector<Index>& corners = {});

// Meshes for the verification of orders: regular, or distorted in a pattern that repeats from cell
// to cell, so that refinement does not smooth it out.

struct RectangleMesh {
  double length = 0;  ///< along x, from the origin [m]
  double height = 0;  ///< along y [m]
  Index cells = 1;    ///< along either side; each cell is two triangles, diagonals alternate
  bool six_nodes = false;
  double distortion = 0;  ///< how far inner corners are moved, in cells; below 0.3
};

/// A model with one plate and its triangles: neither supports nor loads.
/// @throws ModelError  for a distortion that could turn a triangle over.
[[nodiscard]] Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate);

struct DistortedLine {
  Vector2d start = Vector2d::Zero();  ///< [m]
  Vector2d end = Vector2d::Zero();    ///< [m]
  Index cells = 1;
  double distortion = 0;  ///< how far every other inner node is moved, in cells; below 1
};

/// A model with one member a cell, its first node at the start.
/// @param member  its nodes and number of elements do not matter
/// @throws ModelError  for a distortion that could turn a member over.
[[nodiscard]] Model mesh_line(const DistortedLine& mesh, const Member& member);

}  // namespace trammel::solver
