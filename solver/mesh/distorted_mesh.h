#pragma once

#include "solver/model/model.h"

/// Meshes for the verification of orders: regular, or distorted in a pattern that repeats from cell
/// to cell, so that refinement does not smooth it out.
namespace trammel::solver {

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
