#include "harness/scene/eigen_path.h"

namespace trammel {

EigenPath read_eigen_path(const Cursor& analysis) {
  const std::string path = analysis.get<std::string>("path", "automatic");
  if (path == "dense") return EigenPath::dense;
  return path == "sparse" ? EigenPath::sparse : EigenPath::automatic;
}

}  // namespace trammel
