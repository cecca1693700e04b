#pragma once

#include <optional>

#include "solver/large_motion/elements/constrained_system.h"

namespace trammel::solver::large_motion {

/// How one step ended.
struct StepReport {
  bool converged = false;
  int iterations = 0;
  double correction = 0;  ///< last correction of the positions, over the scale [-]
  double error = 0;       ///< estimate of the local error in position, over the scale [-]
};

/// What a step did to the energy [J].
struct EnergyStep {
  Energy before, after;
  double work = 0;  ///< of what is not conservative
};

/// A time integrator: one step from a consistent state.
class Stepper {
 public:
  Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  Stepper(Stepper&&) = delete;
  Stepper& operator=(Stepper&&) = delete;
  virtual ~Stepper() = default;

  /// Tries a step of size h [s] from the state `begin` was given or the last accepted one to the
  /// time `end`; the result waits in `next` until it is accepted.
  [[nodiscard]] virtual StepReport attempt(double h, double end) = 0;
  virtual void begin(const State& state) = 0;
  /// The loads bend where the last step has ended: accelerations do not go on as before.
  virtual void restart() {}
  virtual void accept() = 0;
  [[nodiscard]] virtual const State& state() const = 0;
  [[nodiscard]] virtual const State& next() const = 0;
  [[nodiscard]] virtual const KktMatrix& matrix() const = 0;
  /// The method's equation of motion of the step accepted last, from its states alone.
  virtual void force_residual(Eigen::Ref<VectorXd> r) const = 0;
  /// How far that step's q, v and a are from the method's relations, over their terms [-].
  [[nodiscard]] virtual double relation_residual() const = 0;
  /// Whether velocities meet the constraints at the ends of steps.
  [[nodiscard]] virtual bool keeps_rates() const = 0;
  /// Of the step accepted last, where the method has an exact balance of energy.
  [[nodiscard]] virtual std::optional<EnergyStep> energy_step() const { return std::nullopt; }
};

}  // namespace trammel::solver::large_motion
