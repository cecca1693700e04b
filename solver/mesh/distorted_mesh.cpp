#include "solver/mesh/distorted_mesh.h"

#include <map>
#include <string>

namespace trammel::solver {
namespace {

/// -1, 0 or 1: a pattern with a period of three cells.
double pattern(Index n) {
  return static_cast<double>(n % 3) - 1;
}

class Rectangle {
 public:
  Rectangle(const RectangleMesh& mesh, const Plate& plate) : mesh_(mesh) {
    model_.plates.push_back(plate);
  }

  Model build() {
    for (Index j = 0; j <= mesh_.cells; ++j) {
      for (Index i = 0; i <= mesh_.cells; ++i) add_node(corner(i, j));
    }
    for (Index j = 0; j < mesh_.cells; ++j) {
      for (Index i = 0; i < mesh_.cells; ++i) add_cell(i, j);
    }
    return std::move(model_);
  }

 private:
  [[nodiscard]] Vector2d corner(Index i, Index j) const {
    Vector2d at(static_cast<double>(i), static_cast<double>(j));
    const bool inside = i > 0 && j > 0 && i < mesh_.cells && j < mesh_.cells;
    if (inside) at += mesh_.distortion * Vector2d(pattern(i + 2 * j), pattern(2 * i + j + i * j));
    return at.cwiseProduct(Vector2d(mesh_.length, mesh_.height)) / static_cast<double>(mesh_.cells);
  }

  Index add_node(const Vector2d& position) {
    model_.nodes.push_back({std::to_string(model_.nodes.size()), position});
    return static_cast<Index>(model_.nodes.size()) - 1;
  }

  void add_cell(Index i, Index j) {
    const Index a = i + j * (mesh_.cells + 1);
    const Index b = a + 1;
    const Index d = a + mesh_.cells + 1;
    const Index c = d + 1;
    if ((i + j) % 2 == 0) {
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    } else {
      add_triangle(a, b, d);
      add_triangle(b, c, d);
    }
  }

  void add_triangle(Index a, Index b, Index c) {
    Triangle triangle;
    triangle.nodes = {a, b, c, -1, -1, -1};
    if (mesh_.six_nodes) {
      triangle.nodes[3] = middle(a, b);
      triangle.nodes[4] = middle(b, c);
      triangle.nodes[5] = middle(c, a);
    }
    model_.triangles.push_back(triangle);
  }

  Index middle(Index a, Index b) {
    const auto [entry, added] = middle_.try_emplace(std::minmax(a, b), 0);
    if (added) {
      const Vector2d sum = model_.nodes[static_cast<std::size_t>(a)].position +
                           model_.nodes[static_cast<std::size_t>(b)].position;
      entry->second = add_node(sum / 2);
    }
    return entry->second;
  }

  RectangleMesh mesh_;
  Model model_;
  std::map<std::pair<Index, Index>, Index> middle_;
};

}  // namespace

Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate) {
  if (!(mesh.distortion >= 0 && mesh.distortion < 0.3)) {
    throw ModelError("the distortion of a rectangle's mesh must lie between 0 and 0.3");
  }
  return Rectangle(mesh, plate).build();
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
