#pragma once

#include "solver/large/consistent_initialization.h"
#include "solver/large/constrained_stepper.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/motion/integrate.h"

namespace trammel::solver::large_motion {

/// Result of an integration in large motion.
struct IntegrationSummary : TransientSummary {
  ConstraintGaps constraints;  ///< largest at any observed time
};

/// Integrates by generalized-alpha from a consistent state to the end time. `state` becomes the
/// last state.
[[nodiscard]] IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// Integrates from the pose of the model with its initial velocities, also by energy-momentum.
[[nodiscard]] IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// Integrates with `step` and `step`/2 and extrapolates to remove the common second-order error.
/// The result has order 3 (order 4 by energy-momentum). The step is fixed, and sample times must be
/// multiples of it. Observed states contain q, v and lambda only. They satisfy constraints up to
/// their error. The outcome is not_converged if this error exceeds a thousandth of the model size.
[[nodiscard]] IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system,
                                                        State& state,
                                                        const TransientOptions& options,
                                                        const Observer& observe = {});

}  // namespace trammel::solver::large_motion
