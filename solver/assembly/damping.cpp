#include "solver/assembly/damping.h"

#include <cmath>
#include <limits>

namespace trammel::solver {

double damping_ratio(const RayleighDamping& damping, double omega) {
  return (damping.mass / omega + damping.stiffness * omega) / 2;
}

Eigen::VectorXd decay_rates(const RayleighDamping& damping, const Eigen::VectorXd& omega) {
  return 0.5 * (damping.mass + damping.stiffness * omega.array().square());
}

OverdampedRange overdamped_range(const RayleighDamping& damping) {
  const double product = damping.mass * damping.stiffness;
  if (product >= 1) return {1 / damping.stiffness, 1 / damping.stiffness};
  const double sum = 1 + std::sqrt(1 - product);
  return {damping.mass / sum, damping.stiffness > 0 ? sum / damping.stiffness
                                                    : std::numeric_limits<double>::infinity()};
}

SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                            const SparseMatrix& K) {
  return damping.mass * M + damping.stiffness * K;
}

SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                  const Eigen::MatrixXd& shape, const Eigen::VectorXd& ratio) {
  if (shape.rows() != M.rows() || shape.cols() != omega.size() || ratio.size() != omega.size()) {
    throw ModelError("modal damping has one ratio for each mode");
  }
  const Eigen::MatrixXd inertia = M * shape;
  const Eigen::VectorXd factor = 2 * ratio.cwiseProduct(omega);
  const Eigen::MatrixXd C = inertia * factor.asDiagonal() * inertia.transpose();
  SparseMatrix sparse = C.sparseView();
  sparse.makeCompressed();
  return sparse;
}

}  // namespace trammel::solver
