#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/text.h"
#include "harness/input/json_view.h"
#include "harness/readers/model_fields.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::harness {

/// @param what  for the message: "a node", "a section"
/// @throws InputError  at `place`, with the nearest name.
template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const std::string& name,
                               const JsonView& place, const std::string& what) {
  const auto found = named.find(name);
  if (found != named.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& item : named) names.push_back(item.first);
  throw place.error(unknown_name("the name of " + what, name, names));
}

/// The same for a name in the document.
template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const JsonView& name,
                               const std::string& what) {
  return look_up(named, name.get<std::string>(), name, what);
}

/// Sides of meshed blocks.
struct Edge {
  struct Piece {
    solver::Index plate = -1;          ///< the one plate there; -1: the side lies inside
    std::vector<solver::Index> nodes;  ///< middles included; the plate is to the left of the way
    bool six_nodes = false;
  };
  std::vector<Piece> pieces;
};

/// Parts of a planar model by name.
struct SymbolTable {
  std::map<std::string, solver::Index> node;
  std::map<std::string, solver::Material> material;
  std::map<std::string, solver::Section> section;
  std::map<std::string, std::string> section_shape;  ///< section -> "rectangle", "circle" or ""
  std::map<std::string, Edge> edge;

  [[nodiscard]] solver::Index find_node(const JsonView& name) const {
    return look_up(node, name, "a node");
  }
};

template <class T>
concept ScalarField = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Reads the members of a place that has passed its schema. Absent keys leave their member as it
/// is.
class FieldReader {
 public:
  /// @param symbols  null for parts that name no others
  explicit FieldReader(JsonView place, const SymbolTable* symbols = nullptr)
      : place_(std::move(place)), symbols_(symbols) {}

  template <class T>
  void optional(const char* key, T&& member) const {
    if (const auto found = place_.find(key)) read(*found, member);
  }
  template <class T>
  void required(const char* key, T&& member) const {
    optional(key, member);
  }
  template <class T>
  void defaulted(const char* key, T&& member) const {
    optional(key, member);
  }

  static void read(const JsonView& place, ScalarField auto& value) {
    value = place.get<std::decay_t<decltype(value)>>();
  }
  static void read(const JsonView& place, Eigen::Ref<Eigen::Vector2d> pair) {
    pair << place[0].get<double>(), place[1].get<double>();
  }
  /// Accepts a word in place of a number that is computed.
  static void read(const JsonView& place, std::optional<double>& value) {
    value.reset();
    if (place.json().is_number()) value = place.get<double>();
  }
  template <class Kind>
  static void read_connection(const JsonView& place, Kind& kind, double& stiffness) {
    if (!place.json().is_object()) return read(place, kind);
    kind = Kind::sprung;
    stiffness = place.number("spring_N_m_per_rad");
  }
  static void read(const JsonView& place, solver::MemberEnd& end) {
    read_connection(place, end.fixity, end.stiffness);
  }
  template <class Kind>
  static void read(const JsonView& place, solver::Joint<Kind>& joint) {
    read_connection(place, joint.kind, joint.stiffness);
  }
  /// One for all, or one for each.
  template <class T, std::size_t N>
  static void read(const JsonView& place, std::array<T, N>& values) {
    for (std::size_t i = 0; i < N; ++i) read(place.json().is_array() ? place[i] : place, values[i]);
  }
  static void read(const JsonView& place, std::array<bool, 3>& motions) {
    for (const auto& entry : place.entries())
      motions[static_cast<std::size_t>(entry.second.get<NodeMotion>())] = true;
  }
  void read(const JsonView& place, solver::Section& section) const {
    section = look_up(symbols_->section, place, "a section");
  }
  void read(const JsonView& place, solver::Material& material) const {
    material = look_up(symbols_->material, place, "a material");
  }
  void read(const JsonView& place, NodeNames<solver::Index>& node) const {
    node.indices = symbols_->find_node(place);
  }
  template <class Indices>
  void read(const JsonView& place, NodeNames<Indices>& nodes) const {
    if constexpr (requires { nodes.indices.resize(1); }) nodes.indices.resize(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) nodes.indices[i] = symbols_->find_node(place[i]);
  }

 private:
  JsonView place_;
  const SymbolTable* symbols_;
};

/// A part by the list of its fields.
template <class T>
[[nodiscard]] T read_part(const JsonView& place, const SymbolTable* symbols = nullptr) {
  T part{};
  const FieldReader reader(place, symbols);
  fields(reader, part);
  return part;
}

/// The parts below a key that may be missing, which `check(place, part)` may refuse.
template <class T, class Check = void (*)(const JsonView&, const T&)>
[[nodiscard]] std::vector<T> read_parts(
    const JsonView& model, const char* key, const SymbolTable& symbols,
    const Check& check = [](const JsonView&, const T&) {}) {
  std::vector<T> parts;
  for (const auto& [name, place] : model.entries(key)) {
    parts.push_back(read_part<T>(place, &symbols));
    if constexpr (requires { parts.back().name; }) parts.back().name = name;
    check(place, parts.back());
  }
  return parts;
}

[[nodiscard]] inline Eigen::Vector2d read_point(const JsonView& point) {
  return {point[0].get<double>(), point[1].get<double>()};
}

[[nodiscard]] inline solver::Material read_material(const JsonView& material) {
  return read_part<solver::Material>(material);
}

/// Plates: triangle by triangle, or meshed from blocks. A block is a quadrilateral between four
/// named nodes; where an edge names the way between two of them, it may be an arc of an ellipse,
/// and it can be loaded and supported. Nodes that stand where the mesh has one become part of it,
/// so that blocks, plates and frames that touch are joined.

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
