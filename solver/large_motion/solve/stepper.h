#pragma once

#include "solver/large_motion/elements/constrained_system.h"

namespace trammel::solver::large_motion {

/// How one step ended.
struct StepReport {
  bool converged = false;
  int iterations = 0;
  double correction = 0;  ///< last correction of the positions, over the scale [-]
  double error = 0;       ///< estimate of the local error in position, over the scale [-]
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

  /// Tries a step of size h [s] from the state `begin` was given or the last accepted one; the
  /// result waits in `next` until it is accepted.
  [[nodiscard]] virtual StepReport attempt(double h) = 0;
  virtual void begin(const State& state) = 0;
  virtual void accept() = 0;
  [[nodiscard]] virtual const State& state() const = 0;
  [[nodiscard]] virtual const State& next() const = 0;
  [[nodiscard]] virtual const KktMatrix& matrix() const = 0;
};

}  // namespace trammel::solver::large_motion
