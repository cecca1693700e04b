#pragma once

#include "harness/readers/field_reader.h"

/// Plates: triangle by triangle, or meshed from blocks. A block is a quadrilateral between four
/// named nodes; where an edge names the way between two of them, it may be an arc of an ellipse,
/// and it can be loaded and supported. Nodes that stand where the mesh has one become part of it,
/// so that blocks, plates and frames that touch are joined.
namespace trammel::harness {

/// Adds plates, triangles and the nodes of meshes to `structure`, and the edges to `symbols`.
/// @param model  the place /model
/// @throws InputError  where names lead nowhere or geometry is impossible.
void read_plates(const JsonView& model, SymbolTable& symbols, solver::Model& structure);

/// Nodes on an edge, each once.
[[nodiscard]] std::vector<solver::Index> nodes_of(const Edge& edge);

/// A traction on an edge.
void read_edge_load(const JsonView& place, const SymbolTable& symbols, solver::Model& structure);

/// @param first  nodes of `structure` before this one are the manipulator's
/// @throws InputError  at a named node that nothing holds on to, where there is a mesh that was
/// meant to.
void check_meshed_nodes(const JsonView& model, std::size_t first, const solver::Model& structure);

}  // namespace trammel::harness
