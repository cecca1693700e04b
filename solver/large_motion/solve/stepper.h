#pragma once

#include "solver/large_motion/system/constrained_system.h"

namespace trammel::large {

/// How one step ended.
struct StepReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< last correction of the positions, over the scale [-]
  double error = 0;     ///< estimate of the local error in position, over the scale [-]
};

/// Watches the corrections of one step's iteration: of the motion, and of the positions onto the
/// constraints.
class StepConvergence {
 public:
  void record(double moved, double shifted) {
    before_moved_ = moved_;
    before_shifted_ = shifted_;
    moved_ = moved;
    shifted_ = shifted;
    ++count_;
  }
  /// @param accelerated  h^2 beta a, what the accelerations contribute to the step; travelled: h v;
  ///                     place: q; all over the scale.
  [[nodiscard]] bool done(double accelerated, double travelled, double place) const {
    const bool stalled = count_ > 2 && moved_ > 0.3 * before_moved_;
    const bool motion = moved_ <= 1e-11 * accelerated || moved_ <= 1e-16 * travelled ||
                        (stalled && moved_ <= 1e-11 * (travelled + accelerated) + 1e-15 * place);
    const bool held = shifted_ <= 1e-15 * place || shifted_ <= 1e-13 * travelled ||
                      (count_ > 2 && shifted_ > 0.3 * before_shifted_ && shifted_ < 1e-12);
    return motion && held;
  }
  [[nodiscard]] bool slow() const { return count_ > 1 && last() > 0.1 * before(); }
  [[nodiscard]] bool hopeless() const { return count_ > 4 && last() > 2 * before(); }
  [[nodiscard]] double last() const { return moved_ + shifted_; }

 private:
  [[nodiscard]] double before() const { return before_moved_ + before_shifted_; }

  double moved_ = 0, shifted_ = 0, before_moved_ = 0, before_shifted_ = 0;
  int count_ = 0;
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

}  // namespace trammel::large
