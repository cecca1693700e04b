#include "solver/linalg/backward_error.h"

#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::solver {

double largest_ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& terms) {
  double largest = 0;
  for (Index i = 0; i < residual.size(); ++i) {
    if (residual[i] == 0 && terms[i] >= 0) continue;
    largest = nan_max(largest, std::abs(residual[i]) / terms[i]);
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace trammel::solver
