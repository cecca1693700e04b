#pragma once

#include "solver/large/consistent_initialization.h"
#include "solver/large/constrained_stepper.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/motion/integrate.h"

namespace trammel::solver::large_motion {

/// Result of a time integration in large motion.
struct IntegrationSummary : TransientSummary {
  ConstraintGaps constraints;  ///< largest constraint residuals of all output states
};

/// Integrates the motion by the generalized-alpha method from a consistent state to the end time.
/// `state` becomes the last state.
[[nodiscard]] IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// Integrates the motion from the pose of the model with its initial velocities, by the
/// generalized-alpha or the energy-momentum method.
[[nodiscard]] IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                                           const TransientOptions& options,
                                           const Observer& observe = {});

/// Integrates the motion with the time steps `step` and `step`/2 and extrapolates the two results,
/// which removes the error of second order in the step. The result has order 3 (order 4 by
/// energy-momentum). The step is fixed, and sample times must be multiples of the step. Output
/// states contain q, v and lambda only. These states satisfy the constraints up to the
/// extrapolation error. The outcome is not_converged if this error exceeds a thousandth of the
/// model size.
[[nodiscard]] IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system,
                                                        State& state,
                                                        const TransientOptions& options,
                                                        const Observer& observe = {});

}  // namespace trammel::solver::large_motion
