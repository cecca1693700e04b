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

/// Returns the value of the map `named` for the name that the case states at `place`.
/// @param kind  noun for the error message: "a node", "a section"
/// @throws InputError  at `place`, with the most similar known name, if the name is unknown.
template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const std::string& name,
                               const JsonView& place, const std::string& kind) {
  const auto found = named.find(name);
  if (found != named.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& item : named) names.push_back(item.first);
  throw place.error(unknown_name_message("the name of " + kind, name, names));
}

template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const JsonView& name,
                               const std::string& kind) {
  return look_up(named, name.get<std::string>(), name, kind);
}

/// Edge of plates, composed of sides of meshed blocks.
struct Edge {
  struct Piece {
    solver::Index plate = -1;  ///< index of the plate; -1 if there are blocks on both sides
    /// Nodes in order, including midside nodes. The plate is to the left of this sequence.
    std::vector<solver::Index> nodes;
    bool six_nodes = false;
  };
  std::vector<Piece> pieces;
};

struct SymbolTable {
  std::map<std::string, solver::Index> node;
  std::map<std::string, solver::Material> material;
  std::map<std::string, solver::Section> section;
  std::map<std::string, std::string>
      section_shape;  ///< shape of each section: "rectangle", "circle", ""
  std::map<std::string, Edge> edge;

  [[nodiscard]] solver::Index find_node(const JsonView& name) const {
    return look_up(node, name, "a node");
  }
};

template <class T>
concept ScalarField = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Reads the fields of a structure from a JSON object. A field without a key remains unchanged.
class FieldReader {
 public:
  /// @param symbols  names of parts (nodes, sections, ...) to which the object may refer; null if
  ///   the object refers to no part
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
  /// Reads a mass or moment of inertia. If the case contains a text instead of a number, `value`
  /// becomes empty.
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
  /// Reads an array of N values, or a single value that applies to all N entries.
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

/// Reads a part of a model, such as a spring. The function `visit_fields` of the type
/// lists the keys.
template <class T>
[[nodiscard]] T read_part(const JsonView& place, const SymbolTable* symbols = nullptr) {
  T part{};
  const FieldReader reader(place, symbols);
  visit_fields(reader, part);
  return part;
}

/// Reads all parts below an optional key, such as "springs". `check(place, part)` throws InputError
/// for an invalid part.
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

/// Plates consist of explicit triangles or of meshed blocks. A block is a quadrilateral between
/// four named nodes. An edge contains sides of blocks, which may be elliptic arcs. An edge can be
/// loaded and supported. A named node at the position of a mesh node becomes part of the
/// mesh. Blocks, plates and frames that touch are therefore connected.

/// Adds plates, triangles and mesh nodes to `structure`, and edges to `symbols`.
/// @param model  the JSON object /model of the case
/// @throws InputError  if a name is unknown or the geometry is impossible.
void read_plates(const JsonView& model, SymbolTable& symbols, solver::Model& structure);

/// Returns the nodes on an edge, without duplicates.
[[nodiscard]] std::vector<solver::Index> nodes_on_edge(const Edge& edge);

/// Reads a traction or normal stress on an edge of a plate.
void read_edge_load(const JsonView& place, const SymbolTable& symbols, solver::Model& structure);

/// Requires that every named node of a meshed model is connected to an element, body or spring.
/// @param first  index of the first node that does not belong to the manipulator
/// @throws InputError  at a node that is not connected.
void require_connected_nodes(const JsonView& model, std::size_t first,
                             const solver::Model& structure);

}  // namespace trammel::harness
