#include "solver/large_motion/system/linear_constraints.h"

#include <utility>

namespace trammel::solver::large_motion {

namespace {

double dot(const LinearConstraintRow& row, const VectorXd& values) {
  double sum = 0;
  for (std::size_t i = 0; i < row.coordinates.size(); ++i) {
    const Index k = row.coordinates[i];
    if (k < values.size()) sum += row.factors[static_cast<Index>(i)] * values[k];
  }
  return sum;
}

}  // namespace

void LinearConstraints::add(LinearConstraintRow row) {
  zero_blocks_.emplace_back(Eigen::MatrixXd::Zero(row.factors.size(), row.factors.size()));
  rows_.push_back(std::move(row));
}

void LinearConstraints::append_blocks(std::vector<std::vector<Index>>& blocks) {
  first_block_ = static_cast<Index>(blocks.size());
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    std::vector<Index> block;
    for (const Index i : rows_[e].coordinates) block.push_back(i < free_ ? i : -1);
    block.push_back(free_ + first_row_ + static_cast<Index>(e));
    blocks.push_back(std::move(block));
  }
}

void LinearConstraints::add_constraint_forces(const VectorXd& lambda,
                                              Eigen::Ref<VectorXd> r) const {
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const double force = lambda[first_row_ + static_cast<Index>(e)];
    for (std::size_t i = 0; i < rows_[e].coordinates.size(); ++i) {
      const Index k = rows_[e].coordinates[i];
      if (k < r.size()) r[k] += rows_[e].factors[static_cast<Index>(i)] * force;
    }
  }
}

void LinearConstraints::forces(const State& state, double, Eigen::Ref<VectorXd> r) const {
  add_constraint_forces(state.lambda, r);
}

void LinearConstraints::discrete_gradient_forces(const State&, const State&, const VectorXd& lambda,
                                                 double, Eigen::Ref<VectorXd> r) const {
  add_constraint_forces(lambda, r);
}

void LinearConstraints::constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                                            Eigen::Ref<VectorXd> rate) const {
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const Index row = first_row_ + static_cast<Index>(e);
    residual[row] = dot(rows_[e], state.q);
    rate[row] = dot(rows_[e], state.v);
  }
}

void LinearConstraints::tangent(const State&, double, const TangentCoefficients& coefficients,
                                KktMatrix& matrix) const {
  const Eigen::Matrix<double, 1, 1> c = Eigen::Matrix<double, 1, 1>::Zero();
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const double norm = rows_[e].factors.squaredNorm();
    const Eigen::Matrix<double, 1, 1> rho((coefficients.stiffness * rows_[e].stiffness_scale +
                                           coefficients.mass * rows_[e].mass_scale) /
                                          norm);
    matrix.add(first_block_ + static_cast<Index>(e), zero_blocks_[e],
               Eigen::RowVectorXd(rows_[e].factors.transpose()), c, rho);
  }
}

}  // namespace trammel::solver::large_motion
