#include "solver/mesh/distorted_mesh.h"

#include <set>
#include <string>

#include "solver/mesh/block_mesh.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

/// -1, 0 or 1: a pattern with a period of three cells.
double pattern(Index n) {
  return static_cast<double>(n % 3) - 1;
}

}  // namespace

Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate) {
  if (!(mesh.distortion >= 0 && mesh.distortion < 0.3)) {
    throw ModelError("the distortion of a rectangle's mesh must lie between 0 and 0.3");
  }
  const auto cells = static_cast<double>(mesh.cells);
  const Vector2d size(mesh.length, mesh.height);
  const Vector2d x = size.x() * Vector2d::UnitX(), y = size.y() * Vector2d::UnitY();
  BlockMesh block = mesh_blocks(
      {{{Vector2d::Zero(), x, size, y}, {}, {mesh.cells, mesh.cells}, {1, 1}}}, mesh.six_nodes);
  const auto distort = [&](Vector2d& position) {
    Vector2d at = (cells * position.cwiseQuotient(size)).array().round();  // its row and column
    const auto i = static_cast<Index>(at.x()), j = static_cast<Index>(at.y());
    const bool inside = i > 0 && j > 0 && i < mesh.cells && j < mesh.cells;
    if (inside) at += mesh.distortion * Vector2d(pattern(i + 2 * j), pattern(2 * i + j + i * j));
    position = at.cwiseProduct(size) / cells;
  };
  std::set<Index> corners;
  for (const auto& nodes : block.triangles) corners.insert(nodes.begin(), nodes.begin() + 3);
  for (const Index corner : corners) distort(block.positions[to_size(corner)]);
  for (const auto& nodes : block.triangles) {
    for (std::size_t k = 3; k < 6 && mesh.six_nodes; ++k) {
      block.positions[to_size(nodes[k])] =
          (block.positions[to_size(nodes[k - 3])] + block.positions[to_size(nodes[(k - 2) % 3])]) /
          2;
    }
  }
  Model model;
  model.plates.push_back(plate);
  append(model, 0, block);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) model.nodes[i].name = std::to_string(i);
  return model;
}

Model mesh_line(const DistortedLine& mesh, const Member& member) {
  if (!(mesh.distortion >= 0 && mesh.distortion < 1)) {
    throw ModelError("the distortion of a line's mesh must lie between 0 and 1");
  }
  Model model;
  for (Index i = 0; i <= mesh.cells; ++i) {
    const bool moved = i % 2 == 1 && i < mesh.cells;
    const double at = (static_cast<double>(i) + (moved ? mesh.distortion : 0.0)) /
                      static_cast<double>(mesh.cells);
    model.nodes.push_back({std::to_string(i), (1 - at) * mesh.start + at * mesh.end});
    if (i == 0) continue;
    Member part = member;
    part.name = std::to_string(i - 1) + "-" + std::to_string(i);
    part.nodes = {i - 1, i};
    part.elements = 1;
    model.members.push_back(std::move(part));
  }
  return model;
}

}  // namespace trammel::solver
