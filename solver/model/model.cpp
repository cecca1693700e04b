#include "solver/model/model.h"

namespace trammel::solver {

Index Model::find_node(std::string_view name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == name) return static_cast<Index>(i);
  }
  return -1;
}

std::string part_label(const char* kind, const std::string& name, std::size_t index) {
  return std::string(kind) + ' ' + (name.empty() ? std::to_string(index) : name);
}

std::string node_label(const Model& model, Index node) {
  const auto i = static_cast<std::size_t>(node);
  return part_label("node", model.nodes[i].name, i);
}

std::string member_label(const Model& model, Index member) {
  const auto i = static_cast<std::size_t>(member);
  return part_label("member", model.members[i].name, i);
}

}  // namespace trammel::solver
