#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/base/text.h"
#include "harness/input/json_view.h"
#include "solver/model/model.h"

/// What the parts of a planar model are looked up by.
namespace trammel::harness {

template <class T>
[[nodiscard]] std::vector<std::string> names_of(const std::map<std::string, T>& named) {
  std::vector<std::string> names;
  names.reserve(named.size());
  for (const auto& item : named) names.push_back(item.first);
  return names;
}

/// @param what  for the message: "node", "section"
/// @throws InputError  at `place`, with the nearest name.
template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const std::string& name,
                               const JsonView& place, const std::string& what) {
  const auto found = named.find(name);
  if (found != named.end()) return found->second;
  throw place.error("expected the name of " + what + " (got '" + printable(name) + "')" +
                    did_you_mean(name, names_of(named)));
}

/// The same for a name that stands in the document.
template <class T>
[[nodiscard]] const T& look_up(const std::map<std::string, T>& named, const JsonView& name,
                               const std::string& what) {
  return look_up(named, name.get<std::string>(), name, what);
}

/// Sides of meshed blocks; see plate_reader.h.
struct Edge {
  struct Piece {
    solver::Index plate = -1;          ///< the one plate there; -1: the side lies inside
    std::vector<solver::Index> nodes;  ///< middles included; the plate is to the left of the way
    bool six_nodes = false;
  };
  std::vector<Piece> pieces;
};

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

}  // namespace trammel::harness
