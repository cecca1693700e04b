#pragma once

#include <vector>

#include "solver/large_motion/system/element_group.h"

namespace trammel::solver::large_motion {

/// One row: sum of factor * coordinate = 0.
struct LinearConstraintRow {
  std::vector<Index> coordinates;
  VectorXd factors;
  double stiffness_scale = 1, mass_scale = 1;  ///< of what is joined, for rho
};

/// Linear constraints between coordinates.
class LinearConstraints final : public ElementGroup {
 public:
  LinearConstraints(Index free, Index first_row) : free_(free), first_row_(first_row) {}

  void add(LinearConstraintRow row);

  void append_blocks(std::vector<std::vector<Index>>& blocks) override;
  void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const override;
  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const override;
  void tangent(const State& state, double tau, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override;
  void discrete_gradient_forces(const State& from, const State& to, const VectorXd& lambda,
                                double tau, Eigen::Ref<VectorXd> r) const override;
  [[nodiscard]] Index size() const override { return static_cast<Index>(rows_.size()); }
  std::vector<LinearConstraintRow>& rows() { return rows_; }

 private:
  void add_constraint_forces(const VectorXd& lambda, Eigen::Ref<VectorXd> r) const;

  Index free_ = 0, first_row_ = 0, first_block_ = 0;
  std::vector<LinearConstraintRow> rows_;
  std::vector<Eigen::MatrixXd> zero_blocks_;  ///< a zero S of each row's size
};

}  // namespace trammel::solver::large_motion
