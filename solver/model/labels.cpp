#include "solver/model/labels.h"

namespace trammel::solver {

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
