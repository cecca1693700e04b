#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "harness/readers/field_reader.h"
#include "solver/elements/block_mesh.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// Indices of the two end nodes of a side, in ascending order.
using Ends = std::pair<solver::Index, solver::Index>;
Ends ends_of(solver::Index a, solver::Index b) {
  return std::minmax(a, b);
}

const Eigen::Vector2d& node_position(const solver::Model& structure, solver::Index node) {
  return structure.nodes[solver::to_size(node)].position;
}

std::string describe_point(const Eigen::Vector2d& point) {
  return "(" + shortest_decimal(point.x()) + ", " + shortest_decimal(point.y()) + ") m";
}

double twice_triangle_area(const solver::Model& structure, const solver::Triangle& triangle) {
  const Eigen::Vector2d& corner = node_position(structure, triangle.nodes[0]);
  return solver::cross(node_position(structure, triangle.nodes[1]) - corner,
                       node_position(structure, triangle.nodes[2]) - corner);
}

solver::Triangle read_triangle(const JsonView& place, const SymbolTable& symbols,
                               const solver::Model& structure, solver::Index plate) {
  if (place.size() != 3 && place.size() != 6)
    throw place.error("a triangle requires 3 or 6 names of nodes (got " +
                      std::to_string(place.size()) + ")");
  solver::Triangle triangle;
  triangle.plate = plate;
  for (std::size_t i = 0; i < place.size(); ++i) triangle.nodes[i] = symbols.find_node(place[i]);
  const double area = twice_triangle_area(structure, triangle);
  if (area == 0) throw place.error("expected a triangle with an area (got collinear points)");
  if (area < 0) {  // for a clockwise order, swaps two corners and two sides
    std::swap(triangle.nodes[1], triangle.nodes[2]);
    std::swap(triangle.nodes[3], triangle.nodes[5]);
  }
  return triangle;
}

/// Reads the curve of an edge; returns no value for a straight edge.
std::optional<solver::Ellipse> read_curve(const JsonView& edge) {
  if (edge.has("ellipse") && edge.has("circle"))
    throw edge.error("expected at most one of 'ellipse' and 'circle' (got both)");
  if (const auto circle = edge.find("circle")) {
    const double radius = circle->number("radius_m");
    return solver::Ellipse{read_point((*circle)["center_m"]), {radius, radius}};
  }
  const auto ellipse = edge.find("ellipse");
  if (!ellipse) return std::nullopt;
  return solver::Ellipse{read_point((*ellipse)["center_m"]), read_point((*ellipse)["semi_axes_m"])};
}

/// Edges of the plates of a case: corner nodes of each edge, and the curve between adjacent
/// corners.
class Outline {
 public:
  Outline(const JsonView& model, const SymbolTable& symbols, const solver::Model& structure) {
    for (const auto& [name, place] : model.entries("edges")) {
      if (symbols.node.count(name) > 0)
        throw place.error("a node has the same name as this edge; expected another name");
      std::vector<solver::Index>& corners = corners_[name];
      const std::optional<solver::Ellipse> curve = read_curve(place);
      for (const auto& entry : place["nodes"].entries()) {
        corners.push_back(symbols.find_node(entry.second));
        if (curve) check_on_curve(entry.second, *curve, node_position(structure, corners.back()));
        if (corners.size() < 2) continue;
        const Ends ends = ends_of(corners.end()[-2], corners.back());
        if (ends.first == ends.second)
          throw entry.second.error("this node equals the previous one; expected another node");
        if (!curve_.emplace(ends, curve).second)
          throw entry.second.error(
              "the side from the previous node to this one already belongs to an edge; expected "
              "each side in one edge only");
      }
    }
  }

  [[nodiscard]] const std::map<std::string, std::vector<solver::Index>>& corners() const {
    return corners_;
  }
  [[nodiscard]] std::optional<solver::Ellipse> curve(solver::Index a, solver::Index b) const {
    const auto found = curve_.find(ends_of(a, b));
    return found == curve_.end() ? std::nullopt : found->second;
  }

 private:
  static void check_on_curve(const JsonView& place, const solver::Ellipse& curve,
                             const Eigen::Vector2d& point) {
    const double radius = (point - curve.center).cwiseQuotient(curve.semi_axes).norm();
    if (std::abs(radius - 1) < 1e-6) return;
    throw place.error("expected a node on the curve of the edge (got " + describe_point(point) +
                      ", " + shortest_decimal(radius) +
                      " times as far from the center as the curve)");
  }

  std::map<std::string, std::vector<solver::Index>> corners_;
  std::map<Ends, std::optional<solver::Ellipse>> curve_;
};

/// Sides of the meshed blocks of all plates, indexed by the two corner nodes of each side.
class Sides {
 public:
  /// @param piece  side of the block; the plate is to the left of its sequence of nodes
  void add(const JsonView& block, Edge::Piece piece) {
    const Ends ends = ends_of(piece.nodes.front(), piece.nodes.back());
    std::vector<Edge::Piece>& there = sides_[ends];
    if (!there.empty()) {
      const std::vector back(there.front().nodes.rbegin(), there.front().nodes.rend());
      if (there.size() > 1 || back != piece.nodes)
        throw block.error(
            "two blocks with a common side require the same nodes on it (their cells, "
            "grading or elements differ, or the blocks overlap)");
    }
    there.push_back(std::move(piece));
  }

  [[nodiscard]] const std::vector<Edge::Piece>* find(solver::Index a, solver::Index b) const {
    const auto found = sides_.find(ends_of(a, b));
    return found == sides_.end() ? nullptr : &found->second;
  }

 private:
  std::map<Ends, std::vector<Edge::Piece>> sides_;
};

solver::Block read_block(const JsonView& place, const SymbolTable& symbols, const Outline& outline,
                         const solver::Model& structure, solver::Index divisions,
                         std::array<solver::Index, 4>& corners) {
  solver::Block block;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = symbols.find_node(place["corners"][i]);
    block.corners[i] = node_position(structure, corners[i]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& here = block.corners[i];
    const double turn =
        solver::cross(block.corners[(i + 1) % 4] - here, block.corners[(i + 3) % 4] - here);
    if (!(turn > 0))
      throw place["corners"].error(
          "expected the corners of a convex quadrilateral in counterclockwise order");
    block.sides[i] = outline.curve(corners[i], corners[(i + 1) % 4]);
    if (i > 1) continue;
    block.cells[i] = divisions * (place.has("cells") ? place["cells"][i].get<solver::Index>() : 1);
    block.grading[i] = place.has("grading") ? place["grading"][i].get<double>() : 1;
  }
  return block;
}

void mesh_plate(const JsonView& place, const SymbolTable& symbols, const Outline& outline,
                solver::Index plate, solver::Model& structure, Sides& sides) {
  const bool six_nodes = place.get<std::string>("element", "") == "six-node";
  const auto divisions = place.get<solver::Index>("divisions", 1);
  std::vector<solver::Block> blocks;
  std::vector<JsonView> places;
  std::vector<solver::Index> corners;
  for (const auto& entry : place["blocks"].entries()) {
    std::array<solver::Index, 4> of_block{};
    places.push_back(entry.second);
    blocks.push_back(read_block(entry.second, symbols, outline, structure, divisions, of_block));
    corners.insert(corners.end(), of_block.begin(), of_block.end());
  }
  const solver::BlockMesh mesh = solver::mesh_blocks(blocks, six_nodes);
  const std::vector<solver::Index> nodes = solver::append_mesh(structure, plate, mesh, corners);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const std::vector<solver::Index>& of_mesh : mesh.sides[b]) {
      Edge::Piece piece{plate, {}, six_nodes};
      for (const solver::Index node : of_mesh) piece.nodes.push_back(nodes[solver::to_size(node)]);
      sides.add(places[b], std::move(piece));
    }
}

void read_plate(const std::string& name, const JsonView& place, const SymbolTable& symbols,
                const Outline& outline, solver::Model& structure, Sides& sides) {
  if (place.has("triangles") == place.has("blocks"))
    throw place.error("expected exactly one of 'triangles' and 'blocks' (got both or neither)");
  const auto plate = static_cast<solver::Index>(structure.plates.size());
  structure.plates.push_back(read_part<solver::Plate>(place, &symbols));
  structure.plates.back().name = name;
  if (place.has("blocks")) return mesh_plate(place, symbols, outline, plate, structure, sides);
  for (const char* key : {"element", "divisions"})
    if (place.has(key)) throw place[key].error("'" + std::string(key) + "' requires 'blocks'");
  for (const auto& entry : place["triangles"].entries())
    structure.triangles.push_back(read_triangle(entry.second, symbols, structure, plate));
}

Edge find_edge(const JsonView& place, const std::vector<solver::Index>& corners,
               const Sides& sides) {
  Edge edge;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const std::vector<Edge::Piece>* found = sides.find(corners[i], corners[i + 1]);
    if (found == nullptr)
      throw place["nodes"][i + 1].error(
          "no side of a block connects the previous node with this one; expected the two corners "
          "of one side");
    edge.pieces.push_back(found->front());
    // A side between two blocks has no outward normal. The plate index -1 marks a side that cannot
    // be loaded.
    if (found->size() > 1) edge.pieces.back().plate = -1;
  }
  return edge;
}

}  // namespace

void read_plates(const JsonView& model, SymbolTable& symbols, solver::Model& structure) {
  const Outline outline(model, symbols, structure);
  Sides sides;
  for (const auto& [name, place] : model.entries("plates"))
    read_plate(name, place, symbols, outline, structure, sides);
  for (const auto& [name, corners] : outline.corners())
    symbols.edge.emplace(name, find_edge(model["edges"][name], corners, sides));
}

std::vector<solver::Index> nodes_on_edge(const Edge& edge) {
  std::vector<solver::Index> nodes;
  std::set<solver::Index> seen;
  for (const Edge::Piece& piece : edge.pieces)
    for (const solver::Index node : piece.nodes)
      if (seen.insert(node).second) nodes.push_back(node);
  return nodes;
}

void read_edge_load(const JsonView& place, const SymbolTable& symbols, solver::Model& structure) {
  const Edge& edge = look_up(symbols.edge, place["edge"], "an edge");
  solver::EdgeLoad load;
  const FieldReader reader(place);
  reader.optional("traction_Pa", load.traction);
  reader.optional("normal_Pa", load.normal);
  for (const Edge::Piece& piece : edge.pieces) {
    if (piece.plate < 0)
      throw place["edge"].error(
          "a loaded edge requires a plate on one side only (got plates on both sides)");
    load.plate = piece.plate;
    const std::size_t step = piece.six_nodes ? 2 : 1;
    for (std::size_t i = 0; i + step < piece.nodes.size(); i += step) {
      load.nodes = {piece.nodes[i], piece.nodes[i + step],
                    piece.six_nodes ? piece.nodes[i + 1] : -1};
      structure.edge_loads.push_back(load);
    }
  }
}

void require_connected_nodes(const JsonView& model, std::size_t first,
                             const solver::Model& structure) {
  std::vector<bool> held(structure.nodes.size(), false);
  const auto hold = [&](solver::Index node) {
    if (node >= 0) held[solver::to_size(node)] = true;
  };
  const auto hold_all = [&](const auto& nodes) { std::ranges::for_each(nodes, hold); };
  for (const solver::Member& member : structure.members) hold_all(member.nodes);
  for (const solver::Triangle& triangle : structure.triangles) hold_all(triangle.nodes);
  for (const solver::Spring& spring : structure.springs) hold_all(spring.nodes);
  for (const solver::RigidBody& body : structure.rigid_bodies) {
    hold(body.reference);
    hold_all(body.attached);
  }
  const auto unnamed = [&](solver::Index node) {
    return node >= 0 && structure.nodes[solver::to_size(node)].name.empty();
  };
  const bool meshed = std::ranges::any_of(structure.triangles, [&](const auto& triangle) {
    return std::ranges::any_of(triangle.nodes, unnamed);
  });
  for (std::size_t i = first; meshed && i < structure.nodes.size(); ++i) {
    if (held[i]) continue;
    const Eigen::Vector2d& here = structure.nodes[i].position;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = first; k < structure.nodes.size(); ++k)
      if (held[k]) nearest = std::min(nearest, (structure.nodes[k].position - here).norm());
    throw model["nodes"][structure.nodes[i].name].error(
        "the node " + describe_point(here) +
        " is connected to nothing; expected the position of "
        "a mesh node (the nearest one is " +
        shortest_decimal(nearest) + " m away)");
  }
}

}  // namespace trammel::harness
