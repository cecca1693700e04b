#pragma once

#include "solver/large_motion/solve/stepper.h"

namespace trammel::solver::large_motion {

/// Generalized-alpha for constrained systems (J. Chung, G. Hulbert, JAM 60, 1993; M. Arnold,
/// O. Bruls, MSD 18, 2007) with second order in positions, velocities and multipliers, and
/// numerical damping that leaves the spectral radius rho at infinite frequency:
///
///     q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1) + p,   v1 = v0 + h ((1 - gamma) A0 + gamma
///     A1), (1 - am) A1 + am A0 = (1 - af) a1 + af a0,              M a1 + G^T lambda1 = f.
///
/// The index-3 equations are taken in the stabilized form of Gear, Gupta and Leimkuhler: lambda of
/// a rigid row keeps G v + dg/dt = 0 and the small correction p keeps g = 0, so that positions and
/// velocities both stay on the constraints. Multipliers then feel round-off as eps/h, not eps/h^2,
/// and the equations are scaled by h^2, so tiny steps are harmless.
class GeneralizedAlpha final : public Stepper {
 public:
  /// @param spectral_radius  rho in [0, 1]: 1 does not damp high frequencies, 0 annihilates
  ///                          them in one step.
  GeneralizedAlpha(const ConstrainedSystem& system, double spectral_radius);

  [[nodiscard]] StepReport attempt(double h, double end) override;
  void restart() override { first_ = true; }
  void begin(const State& state) override;
  void accept() override;
  [[nodiscard]] const State& state() const override { return from_; }
  [[nodiscard]] const State& next() const override { return to_; }
  [[nodiscard]] const KktMatrix& matrix() const override { return matrix_; }
  void force_residual(Eigen::Ref<VectorXd> r) const override { system_.force_residual(from_, r); }
  /// Without the relation of positions where rigid rows move them by p.
  [[nodiscard]] double relation_residual() const override { return relation_residual_; }
  [[nodiscard]] bool keeps_rates() const override { return true; }

 private:
  [[nodiscard]] StepReport newton(double h);
  [[nodiscard]] StepReport newton(double h, bool exact);
  void predict(double h);
  [[nodiscard]] bool factor(double h);
  void correct(double h);
  [[nodiscard]] double relation_defect(double h);
  [[nodiscard]] double correction_roundoff(double h) const;

  const ConstrainedSystem& system_;
  double alpha_m_, alpha_f_, beta_, gamma_;
  bool has_rigid_rows_;  ///< without them positions and velocities have the same correction
  KktMatrix matrix_;
  State from_, to_;
  VectorXd A0_, A1_, saved_A0_, defect_;  ///< the method's own accelerations
  double last_step_ = 0, factored_step_ = 0, relation_residual_ = 0;
  double end_ = 0;  ///< of the step that is tried [s]
  bool first_ = true;
  VectorXd constraint_residual_, constraint_rate_, velocity_correction_, position_correction_;
};

}  // namespace trammel::solver::large_motion
