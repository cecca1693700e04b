#pragma once

#include "solver/large/consistent_initialization.h"
#include "solver/large/constrained_stepper.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/motion/integrate.h"

namespace trammel::solver::large_motion {

struct IntegrationSummary : TransientSummary {
  ConstraintGaps constraints;  ///< the largest at any observed time
};

/// Integrates by generalized-alpha from a consistent state to the end time; `state` becomes the
/// last one reached.
[[nodiscard]] IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// The same from the model's pose with the model's initial velocities, also by energy-momentum.
[[nodiscard]] IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// Two runs with steps `step` and `step`/2, combined to what their common second-order error
/// leaves: order 3 (order 4 by energy-momentum). The step is fixed and sample times are multiples
/// of it; the state that is observed has q, v and lambda only, and meets constraints as well as its
/// error lets it: not_converged if a thousandth of the model's size is missing.
[[nodiscard]] IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system,
                                                        State& state,
                                                        const TransientOptions& options,
                                                        const Observer& observe = {});

}  // namespace trammel::solver::large_motion
