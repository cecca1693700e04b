#pragma once

#include <vector>

#include "solver/large_motion/system/system_parts.h"

namespace trammel::solver::large_motion {

/// One row: sum of factor * coordinate = 0. Either all coordinates are translations or all are
/// rotations, which is what holds in large motion.
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
  [[nodiscard]] Index rows() const override { return size(); }
  void set_penalty_scales(const PenaltyScales& scales) override;
  void set_row_units(const PenaltyScales& scales, Eigen::Ref<VectorXd> unit) const override;

 private:
  void add_constraint_forces(const VectorXd& lambda, Eigen::Ref<VectorXd> r) const;

  Index free_ = 0, first_row_ = 0, first_block_ = 0;
  std::vector<LinearConstraintRow> rows_;
  std::vector<Eigen::MatrixXd> zero_blocks_;  ///< a zero S of each row's size
};

/// Adds the model's linear constraints, but for those that make two coordinates equal (they are one
/// coordinate of the layout), and the equal rotations of sliders that keep their angle.
/// @throws ModelError  where a constraint names a rotation that no part has, or mixes translations
///                     and rotations.
void add_linear_constraints(const Model& model, const LargeMotionModel& large_motion,
                            const Layout& layout, SystemParts& parts);

}  // namespace trammel::solver::large_motion
