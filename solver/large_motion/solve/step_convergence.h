#pragma once

namespace trammel::solver::large_motion {

/// Watches the corrections of one step's iteration: of the motion, and of the positions onto the
/// constraints.
class StepConvergence {
 public:
  void record(double step_correction, double projection) {
    previous_step_correction_ = step_correction_;
    previous_projection_ = projection_;
    step_correction_ = step_correction;
    projection_ = projection;
    ++count_;
  }
  /// True where the next corrections would be small enough, by how fast they shrink, or where they
  /// have stopped to shrink at round-off.
  /// @param acceleration  h^2 beta a, what the accelerations contribute to the step; velocity: h v;
  ///                     position: q; all over the scale.
  /// @param limit  of the next correction of the motion
  [[nodiscard]] bool converged(double acceleration, double velocity, double position,
                               double limit) const {
    const double next = next_of(step_correction_, previous_step_correction_);
    // Near a singular position corrections multiply the round-off error of positions.
    const double least = 1e-11 * (velocity + acceleration) + 1e-13 * position;
    const bool motion_met = next <= limit || step_correction_ <= 1e-16 * velocity ||
                            (stalled() && step_correction_ <= least);
    const double next_projection = next_of(projection_, previous_projection_);
    const bool constraints_met =
        next_projection <= 1e-15 * position || next_projection <= 1e-13 * velocity ||
        (count_ > 2 && projection_ > 0.3 * previous_projection_ && projection_ < 1e-12);
    return motion_met && constraints_met;
  }
  [[nodiscard]] bool stalled() const {
    return count_ > 2 && step_correction_ > 0.3 * previous_step_correction_;
  }
  [[nodiscard]] bool slow() const { return count_ > 1 && last() > 0.1 * previous(); }
  [[nodiscard]] bool diverging() const { return count_ > 4 && last() > 2 * previous(); }
  [[nodiscard]] double last() const { return step_correction_ + projection_; }

 private:
  /// What the same ratio makes of a correction; the correction itself where there was none before.
  [[nodiscard]] double next_of(double correction, double previous) const {
    return count_ > 1 && correction < previous ? correction * (correction / previous) : correction;
  }
  [[nodiscard]] double previous() const { return previous_step_correction_ + previous_projection_; }

  double step_correction_ = 0, projection_ = 0;
  double previous_step_correction_ = 0, previous_projection_ = 0;
  int count_ = 0;
};

}  // namespace trammel::solver::large_motion
