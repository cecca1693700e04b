#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/large_motion/solve/consistent_initialization.h"
#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/model/evidence.h"
#include "solver/model/outcome.h"

namespace trammel::solver::large_motion {

enum class Integrator { generalized_alpha, energy_momentum };

struct IntegrationOptions {
  Integrator integrator = Integrator::generalized_alpha;
  double end_time = 1;  ///< [s]
  double step = 1e-3;   ///< at most, or the first [s]
  bool adaptive = false;
  double tolerance = 1e-6;  ///< local position error a step over the model's size; adaptive only
  double output_step = 0;   ///< observed at multiples of this, hit exactly; 0: every step [s]
  std::vector<double> output_times =
      {};  ///< or after the start at these, ascending, hit exactly [s]
  std::vector<double> breakpoints = {};  ///< ascending, no step passes over them [s]
  int steps_in_multiples_of = 1;         ///< between outputs and breakpoints; fixed steps only
  double spectral_radius = 0.9;          ///< of generalized-alpha at infinite frequency
  std::int64_t max_steps = 100'000'000;  ///< at most, rejected ones included
};

struct IntegrationSummary {
  Outcome outcome;  ///< not_converged names the step, the time and the residual
  Evidence
      evidence;  ///< constraints of every step; equation of motion at every hundredth of the time
  std::int64_t steps = 0, rejected = 0, iterations = 0;
  double min_step = 0;                 ///< [s]
  double max_constraint_residual = 0;  ///< of a rigid constraint at any observed time [m or rad]
  double max_constraint_rate = 0;      ///< the same of its rate [m/s or rad/s]
  double max_relative_constraint_residual = 0;  ///< over the model's size or 1 rad [-]
  Counters counters;
};

using Observer = std::function<void(const State&)>;

/// Integrates from a consistent state to the end time; `state` becomes the last one reached.
[[nodiscard]] IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                                           const IntegrationOptions& options,
                                           const Observer& observe = {});

/// The same from the model's pose with the model's initial velocities, either integrator.
[[nodiscard]] IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                                           const IntegrationOptions& options,
                                           const Observer& observe = {});

/// Two runs with steps `step` and `step`/2, combined to what their common second-order error
/// leaves: order 3 (order 4 by energy-momentum). The step is fixed and `output_step` a multiple of
/// it; the state that is observed has q, v and lambda only, and meets constraints as well as its
/// error lets it: not_converged where a thousandth of the model's size is missing.
[[nodiscard]] IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system,
                                                        State& state,
                                                        const IntegrationOptions& options,
                                                        const Observer& observe = {});

/// Consistent start of a model: pose, start velocities, accelerations, multipliers.
[[nodiscard]] Outcome initialize_state(const GeometricallyExactSystem& system, State& state,
                                       double step);

}  // namespace trammel::solver::large_motion
