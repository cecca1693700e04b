#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/motion/time_scheme.h"

/// Integration in time: the loop over time steps, the step sizes, and stops at breakpoints. A class
/// derived from `Stepper` implements the equations.
namespace trammel::solver {

/// Error control. In linear systems the sum of the estimated errors of all steps stays below
/// relative * size + absolute [m sqrt(kg)]. The allowed error is distributed evenly in time, so
/// that the global error is proportional to the tolerance. `size` is the largest sqrt(q^T M q)
/// since the start. Before the motion starts, it is estimated from the load. In geometrically exact
/// systems, `relative` bounds the error of each step relative to the model size.
struct ErrorControl {
  double relative = 1e-4;
  double absolute = 0;
  int finest_level = 24;  ///< the smallest step is the largest step / 2^finest_level
};

/// Options of an integration in time.
struct TransientOptions {
  double start = 0;  ///< [s]
  double end = 0;    ///< > start [s]
  /// Size of the time steps [s]. With error control it is the largest step of a linear system and
  /// the first step of a geometrically exact system. The size is reduced so that the time between
  /// two stops is a multiple of the step. Stops are breakpoints and, for geometrically exact
  /// systems, sample times.
  double step = 0;
  TimeScheme scheme = average_acceleration();
  std::optional<ErrorControl> adaptive;  ///< empty: fixed steps
  /// Sample times, ascending, within [start, end] [s]; empty: every step. Steps of geometrically
  /// exact systems end at each sample time. Motions of linear systems are interpolated at these
  /// times.
  std::vector<double> sample_times;
  /// True: start from the solution of K q = f - C v and its velocity v; false: start from q0, v0.
  bool quasi_static_start = false;
  Eigen::VectorXd q0, v0;  ///< empty: zero

  // Options of geometrically exact systems (`breakpoints`, `steps_in_multiples_of`), and the limit
  // `max_steps` for all systems.
  std::vector<double> breakpoints;  ///< ascending; a step ends at each of them [s]
  int steps_in_multiples_of = 1;    ///< divides the number of steps between stops; fixed steps only
  std::int64_t max_steps = 100'000'000;  ///< limit of the number of steps, with rejected ones
};

/// Returns the times start, start + step, ... and the end [s].
[[nodiscard]] std::vector<double> even_times(double start, double end, double step);

/// Result of an integration in time.
struct TransientSummary {
  /// Outcome. singular: a factorization failed. not_converged: a step failed, or a residual of the
  /// motion in `evidence` exceeds its limit. For a failed step, the reason states step, time and
  /// residual.
  Outcome outcome;
  /// Residuals. The equation of motion and the relations of the scheme are checked in up to about
  /// 200 steps, distributed over the time. In linear systems, they are also checked in each step
  /// that contains a sample. Energy and constraints are checked in all steps.
  Evidence evidence;
  double time = 0;  ///< end of the last step [s]
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t iterations = 0;
  double smallest_step = 0, largest_step = 0;  ///< [s]
  /// Largest |M a + C v + K q - f| relative to the sum of the four norms.
  double largest_residual = 0;
  Counters counters;
};

/// Time step.
struct Step {
  double size = 0;    ///< [s]
  double end = 0;     ///< time at the end of the step [s]
  int level = 0;      ///< the size is the largest step / 2^level
  bool last = false;  ///< the step ends at a stop
};

/// Result of an attempted time step.
struct StepReport {
  Status status = Status::not_converged;
  int iterations = 0;
  double residual = 0;  ///< relative residual, or last correction over the model size [-]
  /// Estimated local error relative to the allowed error; 0 without error control.
  double error = 0;
  bool leaves_branch = false;  ///< the mechanism changes its assembly mode within the step
};

/// Interface of a system of equations with a time scheme. It computes single time steps, each from
/// the last accepted state.
class Stepper {
 public:
  Stepper() = default;
  Stepper& operator=(Stepper&&) = delete;  // steppers are neither moved nor copied
  virtual ~Stepper() = default;

  /// Prepares the time steps until the next stop of the integration (breakpoint or sample time).
  [[nodiscard]] virtual Outcome begin(const Step& /*first*/, double /*stop*/) { return {}; }
  /// Attempts a step. The result is pending until it is accepted.
  [[nodiscard]] virtual StepReport attempt(const Step& step) = 0;
  /// Accepts the last attempted step. If `inspect` is true, the equation of motion is also checked.
  /// The residuals are added to `evidence`.
  virtual void accept(const Step& step, bool check_motion, Evidence& evidence) = 0;
  /// Prepares for discontinuous accelerations after a breakpoint.
  virtual void restart() {}
  /// Outputs the last accepted state, at the start and at a sample time.
  virtual void output_state() {}
  /// Describes the last attempt in words, for the reason of a failure.
  [[nodiscard]] virtual std::string describe(const StepReport& report) const = 0;
};

/// Method by which the sizes of time steps are selected.
enum class StepSizes {
  halved,  ///< largest step / 2^level, so that constant matrices need one factorization per level
  free     ///< according to the error; smaller and larger steps if a step does not converge
};

/// Integrates the equations of a stepper to the end time. The integration stops at each breakpoint
/// and, with free step sizes, at each sample time.
[[nodiscard]] TransientSummary integrate(Stepper& stepper, const TransientOptions& options,
                                         const std::vector<double>& breakpoints, StepSizes sizes);

}  // namespace trammel::solver
