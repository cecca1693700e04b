#include "solver/linalg/dense_lu.h"

namespace trammel::solver {

void DenseLu::compute(const Eigen::MatrixXd& A) {
  lu_.compute(A);
}

Eigen::MatrixXd DenseLu::solve(const Eigen::MatrixXd& B) const {
  return lu_.solve(B);
}

}  // namespace trammel::solver
