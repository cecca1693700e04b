#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/motion/time_scheme.h"

/// Integration in time: the loop over steps, their sizes, and stops at breakpoints. A `Stepper`
/// knows the equations.
namespace trammel::solver {

/// Error control. In linear systems the estimated errors of all steps together stay below
/// relative * size + absolute [m sqrt(kg)], shared out evenly in time, so that the global error
/// falls in proportion to the tolerance. The size is the largest sqrt(q^T M q) so far or, before
/// there is a motion, what the load would give it. In geometrically exact systems `relative` bounds
/// the error of each step over the model's size.
struct ErrorControl {
  double relative = 1e-4;
  double absolute = 0;
  int finest_level = 24;  ///< the smallest step is the largest / 2^finest_level
};

struct TransientOptions {
  double start = 0;  ///< [s]
  double end = 0;    ///< > start [s]
  /// The step, or with error control the largest step of a linear system and the first step of a
  /// geometrically exact one [s]. It is shortened so that whole steps fill the time between stops.
  double step = 0;
  TimeScheme scheme = average_acceleration();
  std::optional<ErrorControl> adaptive;  ///< empty: fixed steps
  /// Ascending, within [start, end] [s]; empty: every step. Steps of geometrically exact systems
  /// end there, a linear motion is interpolated.
  std::vector<double> sample_times;
  bool quasi_static_start = false;  ///< K q = f - C v with its velocity; otherwise from q0, v0
  Eigen::VectorXd q0, v0;           ///< empty: zero

  // Options of geometrically exact systems.
  std::vector<double> breakpoints;       ///< ascending; a step ends at each [s]
  int steps_in_multiples_of = 1;         ///< between stops; fixed steps only
  std::int64_t max_steps = 100'000'000;  ///< at most, rejected ones included
};

/// start, start + step, ... and the end. [s]
[[nodiscard]] std::vector<double> even_times(double start, double end, double step);

struct TransientSummary {
  /// singular: no factorization; not_converged: the reason names step, time and residual, or the
  /// evidence does not support the motion.
  Outcome outcome;
  /// The equation of motion and the scheme's relations at 200 steps spread over the time at least;
  /// the energy and the constraints of all steps.
  Evidence evidence;
  double time = 0;  ///< reached [s]
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::int64_t iterations = 0;
  double smallest_step = 0, largest_step = 0;  ///< [s]
  double largest_residual = 0;  ///< |M a + C v + K q - f| over the sum of the four norms, worst
  Counters counters;
};

struct Step {
  double size = 0;    ///< [s]
  double end = 0;     ///< [s]
  int level = 0;      ///< the size is the largest / 2^level
  bool last = false;  ///< before a stop
};

/// How one step ended.
struct StepReport {
  Status status = Status::not_converged;
  int iterations = 0;
  double residual = 0;  ///< of the equations, or the last correction over the model's size [-]
  double error = 0;     ///< estimated local error over what is allowed; 0 without error control
  bool leaves_branch = false;  ///< the mechanism is assembled in another way than before the step
};

/// A system with a scheme: one step from the state accepted last.
class Stepper {
 public:
  Stepper() = default;
  Stepper& operator=(Stepper&&) = delete;  // steppers are neither moved nor copied
  virtual ~Stepper() = default;

  /// Prepares the steps up to the next stop.
  [[nodiscard]] virtual Outcome begin(const Step& /*first*/, double /*stop*/) { return {}; }
  /// Tries a step; the result waits until it is accepted.
  [[nodiscard]] virtual StepReport attempt(const Step& step) = 0;
  /// @param inspect  also checks the equation of motion
  virtual void accept(const Step& step, bool inspect, Evidence& evidence) = 0;
  /// At a breakpoint accelerations do not go on as before.
  virtual void restart() {}
  /// At the start and at a sample time.
  virtual void show() {}
  /// The last attempt in words, for the reason of a failure.
  [[nodiscard]] virtual std::string describe(const StepReport& report) const = 0;
};

enum class StepSizes {
  halved,  ///< largest / 2^level, so that constant matrices need one factorization per level
  free     ///< as the error asks for; smaller and larger ones if a step does not converge
};

/// Steps to the end, with a stop at each breakpoint and, with free sizes, at each sample time.
[[nodiscard]] TransientSummary integrate(Stepper& stepper, const TransientOptions& options,
                                         const std::vector<double>& breakpoints, StepSizes sizes);

}  // namespace trammel::solver
