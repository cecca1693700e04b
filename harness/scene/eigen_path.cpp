#include "harness/scene/eigen_path.h"

namespace trammel {

EigenMethod read_eigen_path(const JsonView& analysis) {
  const std::string path = analysis.get<std::string>("path", "automatic");
  if (path == "dense") return EigenMethod::dense;
  return path == "sparse" ? EigenMethod::sparse : EigenMethod::automatic;
}

}  // namespace trammel
