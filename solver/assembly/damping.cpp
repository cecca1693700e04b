#include "solver/assembly/damping.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::solver {

double damping_ratio(const RayleighDamping& damping, double omega) {
  return (damping.mass / omega + damping.stiffness * omega) / 2;
}

Eigen::VectorXd decay_rates(const RayleighDamping& damping, const Eigen::VectorXd& omega) {
  return 0.5 * (damping.mass + damping.stiffness * omega.array().square());
}

double overdamped_above(const RayleighDamping& damping) {
  if (damping.stiffness == 0) return std::numeric_limits<double>::infinity();
  const double product = std::min(1.0, damping.mass * damping.stiffness);
  return (1 + std::sqrt(1 - product)) / damping.stiffness;
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

Eigen::VectorXd damping_acceleration(const ViscousDamping& damping, const SparseMatrix& M,
                                     const Eigen::VectorXd& v) {
  Eigen::VectorXd a = damping.rayleigh.mass * v;
  if (damping.omega.size() == 0) return a;
  const Eigen::VectorXd amplitude = damping.shape.transpose() * (M * v);
  return a +
         damping.shape * (2 * damping.ratio.cwiseProduct(damping.omega)).cwiseProduct(amplitude);
}

}  // namespace trammel::solver
