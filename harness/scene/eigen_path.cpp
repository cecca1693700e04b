#include "harness/scene/eigen_path.h"

namespace trammel::harness {

solver::EigenMethod read_eigen_path(const JsonView& analysis) {
  const std::string path = analysis.get<std::string>("eigensolver", "automatic");
  if (path == "dense") return solver::EigenMethod::dense;
  return path == "sparse" ? solver::EigenMethod::sparse : solver::EigenMethod::automatic;
}

}  // namespace trammel::harness
