#include "solver/linalg/backward_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::solver {

double largest_ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& terms) {
  double largest = 0;
  for (Index i = 0; i < residual.size(); ++i) {
    if (residual[i] == 0 && terms[i] >= 0) continue;
    const double ratio = std::abs(residual[i]) / terms[i];
    if (!(ratio <= std::numeric_limits<double>::max()))
      return std::numeric_limits<double>::infinity();
    largest = std::max(largest, ratio);
  }
  return largest;
}

}  // namespace trammel::solver
