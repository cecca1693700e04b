#pragma once

#include "solver/large_motion/solve/stepper.h"

namespace trammel::solver::large_motion {

/// Energy-momentum method (J. C. Simo, N. Tarnow, ZAMP 43, 1992; O. Gonzalez, CMAME 190, 2000):
///
///     q1 - q0 = h (v0 + v1)/2,     M (v1 - v0)/h = f(q0, q1) - D(q0, q1)^T lambda,     g(q1) = 0,
///
/// with discrete gradients f and D, so that the energy is kept to round-off for any step, without
/// numerical damping. Momentum is kept within O(h^2). Order 2. Velocities meet their constraint on
/// the mean of each step. Multipliers are means that alternate about those of the motion;
/// `integrate` shows those that follow from positions and velocities.
class EnergyMomentum final : public Stepper {
 public:
  explicit EnergyMomentum(const ConservativeSystem& system);

  [[nodiscard]] StepReport attempt(double h, double end) override;
  void begin(const State& state) override;
  void accept() override;
  [[nodiscard]] const State& state() const override { return from_; }
  [[nodiscard]] const State& next() const override { return to_; }
  [[nodiscard]] const KktMatrix& matrix() const override { return matrix_; }
  void force_residual(Eigen::Ref<VectorXd> r) const override {
    system_.discrete_gradient_residual(to_, from_, previous_mean_lambda_, r);
  }
  [[nodiscard]] double relation_residual() const override { return relation_residual_; }
  [[nodiscard]] bool keeps_rates() const override { return false; }
  [[nodiscard]] std::optional<EnergyStep> energy_step() const override { return energy_step_; }

 private:
  [[nodiscard]] StepReport newton(double h, bool exact);
  void predict(double h);
  [[nodiscard]] bool factor(double h, bool exact);
  void compute_residuals(double h);
  void set_end_multipliers(double h);

  const ConservativeSystem& system_;
  KktMatrix matrix_;
  State from_, to_, midpoint_;
  VectorXd mean_lambda_, previous_mean_lambda_;  ///< multipliers of this step and the last
  double factored_step_ = 0, last_step_ = 0, relation_residual_ = 0;
  double end_ = 0;  ///< of the step that is tried [s]
  bool first_ = true;
  EnergyStep energy_step_;
  VectorXd constraint_residual_, constraint_rate_, previous_constraint_residual_, step_, change_;
};

}  // namespace trammel::solver::large_motion
