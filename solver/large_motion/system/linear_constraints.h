#pragma once

#include <vector>

#include "solver/large_motion/system/element_group.h"

namespace trammel::large {

/// One row: sum of factor * coordinate = 0.
struct LinearRow {
  std::vector<Index> coordinates;
  VectorXd factors;
  double stiffness_scale = 1, mass_scale = 1;  ///< of what is joined, for rho
};

/// Linear constraints between coordinates.
class LinearRows final : public Term {
 public:
  LinearRows(Index free, Index first_row) : free_(free), first_row_(first_row) {}

  void add(LinearRow row);

  void append_blocks(std::vector<std::vector<Index>>& blocks) override;
  void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const override;
  void gaps(const State& state, Eigen::Ref<VectorXd> gap, Eigen::Ref<VectorXd> rate) const override;
  void tangent(const State& state, double tau, const Weights& weights,
               KktMatrix& matrix) const override;
  void secant_forces(const State& from, const State& to, const VectorXd& lambda, double tau,
                     Eigen::Ref<VectorXd> r) const override;
  [[nodiscard]] Index size() const override { return static_cast<Index>(rows_.size()); }
  std::vector<LinearRow>& rows() { return rows_; }

 private:
  void pull(const VectorXd& lambda, Eigen::Ref<VectorXd> r) const;

  Index free_ = 0, first_row_ = 0, first_block_ = 0;
  std::vector<LinearRow> rows_;
  std::vector<Eigen::MatrixXd> nothing_;  ///< a zero S of each row's size
};

}  // namespace trammel::large
