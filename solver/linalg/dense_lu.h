#pragma once

#include <Eigen/LU>

namespace trammel::solver {

/// L U of a square matrix with row exchanges, compiled once. It does not notice a singular matrix.
class DenseLu {
 public:
  DenseLu() = default;
  explicit DenseLu(const Eigen::MatrixXd& A) { compute(A); }
  void compute(const Eigen::MatrixXd& A);
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace trammel::solver
