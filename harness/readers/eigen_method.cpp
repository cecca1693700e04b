#include "harness/readers/eigen_method.h"

namespace trammel::harness {

solver::EigenMethod read_eigen_method(const JsonView& analysis) {
  const std::string method = analysis.get<std::string>("eigensolver", "automatic");
  if (method == "dense") return solver::EigenMethod::dense;
  return method == "sparse" ? solver::EigenMethod::sparse : solver::EigenMethod::automatic;
}

}  // namespace trammel::harness
