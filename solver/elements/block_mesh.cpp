#include "solver/elements/block_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

/// Returns the distance [m] below which two mesh nodes are merged into one node.
double merge_tolerance(const std::vector<Vector2d>& points) {
  return 1e-9 * box_diagonal(points);
}

/// Search structure that finds a mesh node by its position within the merge tolerance.
class Places {
 public:
  explicit Places(double tolerance) : tolerance_(tolerance) {}

  void add(Index node, const Vector2d& position) {
    by_x_.emplace(position.x(), Place{by_x_.size(), node, position});
  }

  /// Returns the index of the node whose distance from `position` is below the merge tolerance, or
  /// -1 if there is no such node. If several nodes match, the node that was added first is
  /// returned.
  [[nodiscard]] Index find(const Vector2d& position) const {
    const Place* first = nullptr;
    auto at = by_x_.lower_bound(position.x() - tolerance_);
    for (; at != by_x_.end() && at->first <= position.x() + tolerance_; ++at) {
      const Place& place = at->second;
      const bool here = (place.position - position).norm() < tolerance_;
      if (here && (!first || place.order < first->order)) first = &place;
    }
    return first ? first->node : -1;
  }

 private:
  struct Place {
    std::size_t order;
    Index node;
    Vector2d position;
  };
  std::multimap<double, Place> by_x_;
  double tolerance_;
};

/// Side of a mesh block as a parametric curve with 0 <= s <= 1: a straight line or an elliptic arc.
class Side {
 public:
  Side(const Vector2d& from, const Vector2d& to, const std::optional<Ellipse>& ellipse)
      : from_(from), to_(to), ellipse_(ellipse) {
    if (!ellipse_) return;
    start_ = angle(from);
    turn_ = angle(to) - start_;
    const double whole = 2 * std::numbers::pi;
    turn_ -= whole * std::round(turn_ / whole);
  }

  [[nodiscard]] Vector2d at(double s) const {
    // The exact corner, without round-off, equals that of adjacent blocks.
    if (s == 0) return from_;
    if (s == 1) return to_;
    if (!ellipse_) return (1 - s) * from_ + s * to_;
    const double t = start_ + s * turn_;
    return ellipse_->center + ellipse_->semi_axes.cwiseProduct(Vector2d(std::cos(t), std::sin(t)));
  }

 private:
  [[nodiscard]] double angle(const Vector2d& point) const {
    const Vector2d p = (point - ellipse_->center).cwiseQuotient(ellipse_->semi_axes);
    if (!(std::abs(p.norm() - 1) < 1e-6))
      throw ModelError("a corner of a mesh block at (" + std::to_string(point.x()) + ", " +
                       std::to_string(point.y()) + ") m does not lie on the ellipse of its side");
    return std::atan2(p.y(), p.x());
  }

  Vector2d from_, to_;
  std::optional<Ellipse> ellipse_;
  double start_ = 0;
  double turn_ = 0;
};

/// Returns the coordinates of the n + 1 grid lines that divide the interval from 0 to 1 into n
/// cells. `grading` is the length of the last cell divided by that of the first cell. For elements
/// with mid-side nodes, n further lines are inserted, each halfway between two adjacent lines.
std::vector<double> lines(Index cells, double grading, bool with_mid_side_nodes) {
  const double q = cells > 1 ? std::pow(grading, 1.0 / static_cast<double>(cells - 1)) : 1;
  std::vector<double> at = {0};
  double step = 1;
  for (Index i = 0; i < cells; ++i, step *= q) at.push_back(at.back() + step);
  for (double& s : at) s /= at.back();
  at.back() = 1;
  if (!with_mid_side_nodes) return at;
  std::vector<double> all = {0};
  for (std::size_t i = 1; i < at.size(); ++i) {
    all.push_back((at[i - 1] + at[i]) / 2);
    all.push_back(at[i]);
  }
  return all;
}

class Mesher {
 public:
  Mesher(bool six_nodes, double tolerance) : outer_(tolerance) { mesh_.six_nodes = six_nodes; }

  BlockMesh mesh() { return std::move(mesh_); }

  void add(const Block& block) {
    if (block.cells[0] < 1 || block.cells[1] < 1)
      throw ModelError("a mesh block must have at least one cell along each side");
    if (!(block.grading[0] > 0 && block.grading[1] > 0))
      throw ModelError("the grading of a mesh block must be positive");
    const bool middles = mesh_.six_nodes;
    const std::vector<double> s = lines(block.cells[0], block.grading[0], middles);
    const std::vector<double> t = lines(block.cells[1], block.grading[1], middles);
    const auto& c = block.corners;
    const Side bottom(c[0], c[1], block.sides[0]);
    const Side right(c[1], c[2], block.sides[1]);
    const Side top(c[2], c[3], block.sides[2]);
    const Side left(c[3], c[0], block.sides[3]);
    const auto point = [&](double x, double y) -> Vector2d {
      if (y == 0) return bottom.at(x);
      if (y == 1) return top.at(1 - x);
      if (x == 0) return left.at(1 - y);
      if (x == 1) return right.at(y);
      return (1 - y) * bottom.at(x) + y * top.at(1 - x) + (1 - x) * left.at(1 - y) +
             x * right.at(y) - (1 - x) * (1 - y) * c[0] - x * (1 - y) * c[1] - x * y * c[2] -
             (1 - x) * y * c[3];
    };
    width_ = s.size();
    grid_.clear();
    for (std::size_t j = 0; j < t.size(); ++j) {
      for (std::size_t i = 0; i < s.size(); ++i) {
        // A node on a side of the block may coincide with a node of an adjacent block.
        const bool outer = i == 0 || j == 0 || i + 1 == s.size() || j + 1 == t.size();
        const Vector2d position = point(s[i], t[j]);
        Index node = outer ? outer_.find(position) : -1;
        if (node < 0) {
          node = std::ssize(mesh_.positions);
          mesh_.positions.push_back(position);
          if (outer) outer_.add(node, position);
        }
        grid_.push_back(node);
      }
    }
    sides(s.size(), t.size());
    triangles(block);
  }

 private:
  [[nodiscard]] Index node(std::size_t i, std::size_t j) const { return grid_[j * width_ + i]; }

  void sides(std::size_t nx, std::size_t ny) {
    std::array<std::vector<Index>, 4> sides;
    for (std::size_t i = 0; i < nx; ++i) sides[0].push_back(node(i, 0));
    for (std::size_t j = 0; j < ny; ++j) sides[1].push_back(node(nx - 1, j));
    for (std::size_t i = nx; i-- > 0;) sides[2].push_back(node(i, ny - 1));
    for (std::size_t j = ny; j-- > 0;) sides[3].push_back(node(0, j));
    mesh_.sides.push_back(std::move(sides));
  }

  void triangles(const Block& block) {
    const std::size_t step = mesh_.six_nodes ? 2 : 1;
    for (std::size_t j = 0; j < static_cast<std::size_t>(block.cells[1]); ++j) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(block.cells[0]); ++i) {
        using Place = std::array<std::size_t, 2>;
        const std::array<Place, 4> q = {Place{i * step, j * step}, Place{(i + 1) * step, j * step},
                                        Place{(i + 1) * step, (j + 1) * step},
                                        Place{i * step, (j + 1) * step}};
        const std::size_t k = (i + j) % 2;  // alternates the diagonal that splits a cell
        triangle(q[k], q[k + 1], q[k + 2]);
        triangle(q[k], q[k + 2], q[(k + 3) % 4]);
      }
    }
  }

  void triangle(const std::array<std::size_t, 2>& a, const std::array<std::size_t, 2>& b,
                const std::array<std::size_t, 2>& c) {
    const auto at = [this](const auto& p) { return node(p[0], p[1]); };
    const auto middle = [&](const auto& p, const auto& q) {
      return mesh_.six_nodes ? node((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) : Index{-1};
    };
    mesh_.triangles.push_back({at(a), at(b), at(c), middle(a, b), middle(b, c), middle(c, a)});
  }

  BlockMesh mesh_;
  Places outer_;             // nodes on the sides of all blocks that are already meshed
  std::vector<Index> grid_;  // node indices of the current block, row by row
  std::size_t width_ = 0;
};

}  // namespace

BlockMesh mesh_blocks(const std::vector<Block>& blocks, bool six_nodes) {
  if (blocks.empty()) throw ModelError("a mesh requires at least one block");
  std::vector<Vector2d> corners;
  for (const Block& block : blocks)
    corners.insert(corners.end(), block.corners.begin(), block.corners.end());
  Mesher mesher(six_nodes, merge_tolerance(corners));
  for (const Block& block : blocks) mesher.add(block);
  return mesher.mesh();
}

std::vector<Index> append_mesh(Model& model, Index plate, const BlockMesh& mesh,
                               const std::vector<Index>& corners) {
  Places places(merge_tolerance(mesh.positions));
  for (const Index corner : corners) places.add(corner, model.nodes[to_size(corner)].position);
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    places.add(static_cast<Index>(i), model.nodes[i].position);
  std::vector<Index> nodes;
  nodes.reserve(mesh.positions.size());
  for (const Vector2d& position : mesh.positions) {
    nodes.push_back(places.find(position));
    if (nodes.back() >= 0) continue;
    nodes.back() = static_cast<Index>(model.nodes.size());
    model.nodes.push_back({"", position});
  }
  for (const std::array<Index, 6>& of_mesh : mesh.triangles) {
    Triangle triangle{plate, of_mesh};
    for (Index& node : triangle.nodes) {
      if (node >= 0) node = nodes[static_cast<std::size_t>(node)];
    }
    model.triangles.push_back(triangle);
  }
  return nodes;
}

namespace {

/// Returns the displacement of a node of a distorted mesh along x or y, divided by the amplitude of
/// the distortion: -1, 0 or 1. n is an integer combination of the row and column of the node. The
/// values repeat with period 3 in n.
double pattern(Index n) {
  return static_cast<double>(n % 3) - 1;
}

}  // namespace

Model mesh_rectangle(const RectangleMesh& mesh, const Plate& plate) {
  if (!(mesh.distortion >= 0 && mesh.distortion < 0.3))
    throw ModelError("the distortion of a rectangle's mesh must be >= 0 and < 0.3 cells");
  const auto cells = static_cast<double>(mesh.cells);
  const Vector2d size(mesh.length, mesh.height);
  const Vector2d x = size.x() * Vector2d::UnitX(), y = size.y() * Vector2d::UnitY();
  BlockMesh block = mesh_blocks(
      {{{Vector2d::Zero(), x, size, y}, {}, {mesh.cells, mesh.cells}, {1, 1}}}, mesh.six_nodes);
  const auto distort = [&](Vector2d& position) {
    // Column and row of the node at `position`, counted in cells from the origin.
    Vector2d at = (cells * position.cwiseQuotient(size)).array().round();
    const auto i = static_cast<Index>(at.x()), j = static_cast<Index>(at.y());
    const bool inside = i > 0 && j > 0 && i < mesh.cells && j < mesh.cells;
    if (inside) at += mesh.distortion * Vector2d(pattern(i + 2 * j), pattern(2 * i + j + i * j));
    position = at.cwiseProduct(size) / cells;
  };
  std::set<Index> corners;
  for (const auto& nodes : block.triangles) corners.insert(nodes.begin(), nodes.begin() + 3);
  for (const Index corner : corners) distort(block.positions[to_size(corner)]);
  for (const auto& nodes : block.triangles) {
    for (std::size_t k = 3; k < 6 && mesh.six_nodes; ++k)
      block.positions[to_size(nodes[k])] =
          (block.positions[to_size(nodes[k - 3])] + block.positions[to_size(nodes[(k - 2) % 3])]) /
          2;
  }
  Model model;
  model.plates.push_back(plate);
  append_mesh(model, 0, block);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) model.nodes[i].name = std::to_string(i);
  return model;
}

Model mesh_line(const DistortedLine& mesh, const Member& member) {
  if (!(mesh.distortion >= 0 && mesh.distortion < 1))
    throw ModelError("the distortion of a line's mesh must be >= 0 and < 1 cell");
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
