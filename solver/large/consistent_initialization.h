#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/large/constrained_system.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/model/evidence.h"

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

/// Half a sentence for the reason of a failure: the drives whose motions the constraints and the
/// other drives do not admit half a step before or after a state; empty if there are none.
[[nodiscard]] std::string contradictory_drives(const GeometricallyExactSystem& system,
                                               const State& state, double step);

/// Sets the accelerations and multipliers of a state from its positions and velocities.
[[nodiscard]] Outcome make_accelerations_consistent(const ConstrainedSystem& system, State& state,
                                                    double step);

/// Velocities of every coordinate where members move as rigid bars, for `make_consistent`: a
/// mechanism that starts in motion without vibration.
/// @param node    of each model node (x, y [m/s], rotation [rad/s]).
/// @param member  angular velocity of each member [rad/s].
[[nodiscard]] PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                                           const Eigen::MatrixX3d& node,
                                                           const VectorXd& member);

}  // namespace trammel::solver::large_motion
