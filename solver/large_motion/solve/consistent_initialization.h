#pragma once

#include <utility>
#include <vector>

#include "solver/large_motion/elements/constrained_system.h"
#include "solver/model/outcome.h"

namespace trammel::solver::large_motion {

/// Which coordinates start with which velocity.
using PrescribedVelocities = std::vector<std::pair<Index, double>>;

/// Makes a state consistent: positions and velocities onto the rigid constraints (velocities by
/// least kinetic energy around those given), then accelerations and multipliers from the equations
/// of motion. What vibrates faster than `step` resolves, and coordinates without mass, take the
/// acceleration that an implicit step of that size gives them.
/// @param state  t and q are the guess; v, a, lambda are replaced.
[[nodiscard]] Outcome make_consistent(const ConstrainedSystem& system, State& state,
                                      const PrescribedVelocities& given, double step);

/// Sets the accelerations and multipliers of a state from its positions and velocities.
[[nodiscard]] Outcome make_accelerations_consistent(const ConstrainedSystem& system, State& state,
                                                    double step);

}  // namespace trammel::solver::large_motion
