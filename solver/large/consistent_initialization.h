#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/large/constrained_system.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Pairs of a coordinate index and the prescribed initial velocity of the coordinate.
using PrescribedVelocities = std::vector<std::pair<Index, double>>;

/// Makes an initial state satisfy the constraints and the equations of motion. Positions and
/// velocities are projected onto the rigid constraints. Velocities that are not prescribed minimize
/// the kinetic energy. Accelerations and Lagrange multipliers follow from the equations of motion.
/// For massless coordinates, and for vibrations that are too fast for `step`, the acceleration of
/// an implicit time step is used.
/// @param system  equations of motion.
/// @param state  initial state: t and an estimate of q are given; v, a and lambda are replaced.
/// @param given  prescribed initial velocities.
/// @param step  size of the first time step [s].
[[nodiscard]] Outcome make_consistent(const ConstrainedSystem& system, State& state,
                                      const PrescribedVelocities& given, double step);

/// Returns a clause for the error message of a failed analysis. The clause lists drives whose
/// motions contradict the constraints or other drives half a time step before or after a state. The
/// clause is empty if there are no such drives.
[[nodiscard]] std::string drive_conflicts_text(const GeometricallyExactSystem& system,
                                               const State& state, double step);

/// Computes the accelerations and Lagrange multipliers of a state from its positions and
/// velocities.
[[nodiscard]] Outcome make_accelerations_consistent(const ConstrainedSystem& system, State& state,
                                                    double step);

/// Returns velocities of all coordinates for members that move as rigid bars. A mechanism that
/// starts with these velocities (see `make_consistent`) has no initial vibration. `node` contains
/// the velocities of each model node (x, y [m/s], rotation [rad/s]), and `member` the angular
/// velocity of each member [rad/s].
[[nodiscard]] PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                                           const Eigen::MatrixX3d& node,
                                                           const VectorXd& member);

}  // namespace trammel::solver::large_motion
