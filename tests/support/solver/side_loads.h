#pragma once

#include <vector>

#include "solver/elements/block_mesh.h"

namespace trammel::testing {

/// The loads of one side, as a traction in world axes and one along the outward normal [Pa].
/// @param nodes  what `append` returned
[[nodiscard]] inline std::vector<solver::EdgeLoad> side_loads(
    const solver::BlockMesh& mesh, const std::vector<solver::Index>& nodes, solver::Index plate,
    std::size_t block, std::size_t side, const solver::Vector2d& traction, double normal) {
  const std::vector<solver::Index>& along = mesh.sides[block][side];
  const auto node = [&](std::size_t i) { return nodes[static_cast<std::size_t>(along[i])]; };
  const std::size_t step = mesh.six_nodes ? 2 : 1;
  std::vector<solver::EdgeLoad> loads;
  for (std::size_t i = 0; i + step < along.size(); i += step) {
    solver::EdgeLoad load;
    load.plate = plate;
    load.nodes = {node(i), node(i + step), mesh.six_nodes ? node(i + 1) : -1};
    load.traction = traction;
    load.normal = normal;
    loads.push_back(load);
  }
  return loads;
}

}  // namespace trammel::testing
