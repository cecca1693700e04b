#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/time/transient.h"

namespace trammel::solver {

/// Below this ratio of pivot to diagonal a mass or stiffness matrix counts as singular.
inline constexpr double kSingularMass = 1e-13;

/// At most a step, within which the load has no jump or kink [s].
[[nodiscard]] double smooth_span(const std::vector<double>& breakpoints,
                                 const TransientOptions& options);

/// K q = f now and at four times after it, within a step and before a jump or kink of the load: the
/// velocity by the one-sided difference of order 4.
/// Then K q = f - C v: otherwise the drag of that velocity would set in at once, and shake what
/// is stiff.
/// @param q, v  at options.start
/// @returns singular where K is.
[[nodiscard]] Outcome start_quasi_statically(EquationMatrices& matrices,
                                             const TransientOptions& options, Eigen::VectorXd& q,
                                             Eigen::VectorXd& v, Counters& counters);

/// Refuses a step at which the fastest motion grows. The power iteration comes from below, so
/// that it refuses no stable step.
[[nodiscard]] Outcome check_stability(const EquationMatrices& matrices,
                                      const TransientOptions& options, Counters& counters);

}  // namespace trammel::solver
