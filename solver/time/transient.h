#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "solver/model/evidence.h"
#include "solver/model/numbers.h"
#include "solver/model/outcome.h"
#include "solver/time/equation_of_motion.h"
#include "solver/time/time_scheme.h"

/// Integration in time of the equation of motion (equation_of_motion.h).
namespace trammel::solver {

/// Error control: the estimated errors of all steps together stay below
/// relative * size + absolute [m sqrt(kg)], shared out evenly in time, so that the global error
/// falls in proportion to the tolerance. The size is the largest sqrt(q^T M q) so far or, before
/// there is a motion, what the load would give it.
struct ErrorControl {
  double relative = 1e-4;
  double absolute = 0;
  int finest_level = 24;  ///< the smallest step is the largest / 2^finest_level
};

struct TransientOptions {
  double start = 0;  ///< [s]
  double end = 0;    ///< > start [s]
  /// The step, or with error control the largest step [s]. It is shortened so that whole steps fill
  /// the time between breakpoints.
  double step = 0;
  TimeScheme scheme = average_acceleration();
  /// Empty: fixed steps. Otherwise steps are `step` / 2^k, so that constant matrices need one
  /// factorization for each k and not one for each change.
  std::optional<ErrorControl> adaptive;
  std::vector<double> sample_times;  ///< ascending, within [start, end] [s]; empty: every step
  bool quasi_static_start = false;   ///< K q = f - C v with its velocity; otherwise from q0, v0
  Eigen::VectorXd q0, v0;            ///< empty: zero
};

/// Energies since the start [J]. Kinetic + strain - work + dissipated stays constant but for what
/// the scheme dissipates or what changing matrices exchange.
struct MotionEnergy {
  double kinetic = 0;     ///< v^T M v / 2
  double strain = 0;      ///< q^T K q / 2
  double work = 0;        ///< of the load, trapezoidal over each step
  double dissipated = 0;  ///< by C, the same way; of a working motion by its drag on its u
  [[nodiscard]] double total() const { return kinetic + strain - work + dissipated; }
};

/// The motion at a sample time: between the ends of a step cubic Hermite in q and in v, linear in a
/// and in the energies. After those inside a step its end is shown, where the equation holds.
struct MotionSample {
  Index index = 0;             ///< -1: the end of a step, and no sample
  double time = 0;             ///< [s]
  const Eigen::VectorXd& q;    ///< [SI]
  const Eigen::VectorXd& v;    ///< q' [SI/s]
  const Eigen::VectorXd& a;    ///< q'' [SI/s^2]
  const MotionEnergy& energy;  ///< [J]
  bool interpolated = false;   ///< inside a step: the equation holds to the error of the steps
};
using MotionObserver = std::function<void(const MotionSample&)>;

struct TransientSummary {
  /// singular: no factorization; not_converged: the reason names step, time and residual, or the
  /// evidence does not bear out the motion.
  Outcome outcome;
  /// Equation of motion and the scheme's relations, at every sample and at a hundred steps spread
  /// over the time at least; energy of all steps.
  Evidence evidence;
  double time = 0;  ///< reached [s]
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  double smallest_step = 0, largest_step = 0;  ///< [s]
  double largest_residual = 0;  ///< |M a + C v + K q - f| over the sum of the four norms, worst
  Counters counters;
};

/// Integrates, handing each sample to the observer. With constant matrices and fixed steps there is
/// one factorization and the loop does not allocate.
/// @throws ModelError  for sizes that differ, a time or step without meaning.
[[nodiscard]] TransientSummary solve_transient(const EquationOfMotion& equation,
                                               const TransientOptions& options,
                                               const MotionObserver& observe);

}  // namespace trammel::solver
