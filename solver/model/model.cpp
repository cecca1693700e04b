#include "solver/model/model.h"

namespace trammel::solver {

Index Model::find_node(std::string_view name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == name) return static_cast<Index>(i);
  }
  return -1;
}

}  // namespace trammel::solver
