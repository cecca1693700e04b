#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/motion/time_scheme.h"

/// Time integration: loop over time steps, selection of step sizes, and stops at breakpoints.
/// Classes derived from `Stepper` implement the equations of motion.
namespace trammel::solver {

/// Error control. In linear systems, the sum of the estimated errors of all steps remains below
/// relative * size + absolute [m sqrt(kg)]. The allowed error is distributed evenly over time, so
/// that the global error is proportional to the tolerance. `size` is the largest sqrt(q^T M q)
/// since the start. Before the motion starts, `size` is estimated from the load. In geometrically
/// exact systems, `relative` bounds the error of each step divided by the model size.
struct ErrorControl {
  double relative = 1e-4;
  double absolute = 0;
  int finest_level = 24;  ///< the smallest step is the largest step / 2^finest_level
};

/// Options of an integration in time.
struct TransientOptions {
  /// Start time [s].
  double start = 0;
  /// End time, > start [s].
  double end = 0;
  /// Size of the time steps [s]. With error control, this is the largest step of a linear system
  /// and the first step of a geometrically exact system. The size is reduced so that the time
  /// between two stops is a multiple of the step. Stops are breakpoints and, for geometrically
  /// exact systems, sample times.
  double step = 0;
  TimeScheme scheme = average_acceleration();
  std::optional<ErrorControl> adaptive;  ///< empty: fixed step size
  /// Sample times, ascending, within [start, end] [s]; empty: the end of every step. Steps of
  /// geometrically exact systems end at each sample time. Motions of linear systems are
  /// interpolated at sample times.
  std::vector<double> sample_times;
  /// true: start from the solution q of K q = f - C v and its velocity v. false: start from q0 and
  /// v0.
  bool quasi_static_start = false;
  /// Initial displacements and velocities; an empty vector means zero.
  Eigen::VectorXd q0, v0;

  // Options of geometrically exact systems (`breakpoints`, `steps_in_multiples_of`), and the limit
  // `max_steps` for all systems.
  /// Breakpoints, ascending; a step ends at each breakpoint [s].
  std::vector<double> breakpoints;
  /// With fixed steps, the number of steps between two stops is a multiple of this number.
  int steps_in_multiples_of = 1;
  /// Limit of the number of accepted and rejected steps.
  std::int64_t max_steps = 100'000'000;
};

/// Returns the equally spaced times start, start + step, ... and the time `end` [s].
[[nodiscard]] std::vector<double> even_times(double start, double end, double step);

/// Result of an integration in time.
struct TransientSummary {
  /// Outcome of the integration. singular: a factorization failed. not_converged: a step failed, or
  /// a residual of the motion in `evidence` exceeds its limit. For a failed step, the reason states
  /// step, time and residual.
  Outcome outcome;
  /// Residuals of the motion. The equation of motion and the relations of the scheme are checked in
  /// up to about 200 steps, distributed over the time. In linear systems, they are also checked in
  /// each step that contains a sample. Energy and constraints are checked in all steps.
  Evidence evidence;
  double time = 0;  ///< end of the last step [s]
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t iterations = 0;
  /// Sizes of the smallest and the largest accepted step [s].
  double smallest_step = 0, largest_step = 0;
  /// Largest |M a + C v + K q - f| of all steps, relative to the sum of the norms of the four
  /// terms.
  double largest_residual = 0;
  Counters counters;
};

/// Size and position in time of a single time step.
struct Step {
  double size = 0;    ///< size of the step [s]
  double end = 0;     ///< time at the end of the step [s]
  int level = 0;      ///< number of halvings: the size is the largest step / 2^level
  bool last = false;  ///< true: the step ends at a breakpoint, sample time or the end time
};

/// Result of an attempt to compute a time step.
struct StepReport {
  Status status = Status::not_converged;
  int iterations = 0;
  /// Relative residual, or last correction divided by the model size [-].
  double residual = 0;
  /// Estimated local error divided by the allowed error; 0 without error control.
  double error = 0;
  /// true: the mechanism changes its assembly mode within the step.
  bool leaves_branch = false;
};

/// Interface of a system of equations of motion with a time scheme. A stepper computes single time
/// steps, each from the last accepted state.
class Stepper {
 public:
  Stepper() = default;
  // Steppers are neither moved nor copied.
  Stepper& operator=(Stepper&&) = delete;
  virtual ~Stepper() = default;

  /// Prepares the time steps up to the next stop of the integration (breakpoint or sample time).
  [[nodiscard]] virtual Outcome begin(const Step& /*first*/, double /*stop*/) { return {}; }
  /// Attempts a step from the last accepted state. The new state is pending until `accept` is
  /// called.
  [[nodiscard]] virtual StepReport attempt(const Step& step) = 0;
  /// Accepts the last attempted step. Residuals of the step are added to `evidence`. If
  /// `check_motion` is true, they include the residual of the equation of motion.
  virtual void accept(const Step& step, bool check_motion, Evidence& evidence) = 0;
  /// Prepares the stepper for discontinuous accelerations after a breakpoint.
  virtual void restart() {}
  /// Outputs the last accepted state. This function is called at the start and at sample times.
  virtual void output_state() {}
  /// Describes the last attempted step in words, for the reason of a failure.
  [[nodiscard]] virtual std::string describe(const StepReport& report) const = 0;
};

/// Methods by which the sizes of time steps are selected.
enum class StepSizes {
  /// Largest step / 2^level. Constant matrices then require one factorization per level.
  halved,
  /// Sizes that follow from the error. If a step does not converge, smaller and larger sizes are
  /// tried.
  free
};

/// Integrates the equations of a stepper from the start time to the end time. The integration stops
/// at each breakpoint and, with free step sizes, at each sample time.
[[nodiscard]] TransientSummary integrate(Stepper& stepper, const TransientOptions& options,
                                         const std::vector<double>& breakpoints, StepSizes sizes);

}  // namespace trammel::solver
