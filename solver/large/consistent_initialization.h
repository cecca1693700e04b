#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/large/constrained_system.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Coordinates and their initial velocities.
using PrescribedVelocities = std::vector<std::pair<Index, double>>;

/// Makes a state consistent. Positions and velocities are projected onto the rigid constraints.
/// Among all velocities with the given values, those of least kinetic energy are selected.
/// Accelerations and multipliers then follow from the equations of motion. Massless coordinates and
/// vibrations that `step` does not resolve get the acceleration of an implicit step of that size.
/// @param system  equations.
/// @param state  t and q are the guess; v, a and lambda are replaced.
/// @param given  prescribed velocities.
/// @param step  size of the first step [s].
[[nodiscard]] Outcome make_consistent(const ConstrainedSystem& system, State& state,
                                      const PrescribedVelocities& given, double step);

/// Returns a clause for the reason of a failure. It lists drives whose motions contradict the
/// constraints and the other drives, half a step before or after a state. The text is empty if
/// there are none.
[[nodiscard]] std::string contradictory_drives(const GeometricallyExactSystem& system,
                                               const State& state, double step);

/// Computes the accelerations and multipliers of a state from its positions and velocities.
[[nodiscard]] Outcome make_accelerations_consistent(const ConstrainedSystem& system, State& state,
                                                    double step);

/// Returns velocities of all coordinates for members that move as rigid bars. With
/// `make_consistent`, a mechanism then starts in motion without vibration.
/// @param system  equations.
/// @param node    velocities of each model node (x, y [m/s], rotation [rad/s]).
/// @param member  angular velocity of each member [rad/s].
[[nodiscard]] PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                                           const Eigen::MatrixX3d& node,
                                                           const VectorXd& member);

}  // namespace trammel::solver::large_motion
