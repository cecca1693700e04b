#pragma once

#include "solver/large_motion/solve/consistent_initialization.h"
#include "solver/large_motion/system/geometrically_exact_system.h"

namespace trammel::solver::large_motion {

/// Velocities of every coordinate where members move as rigid bars, for `make_consistent`: a
/// mechanism that starts in motion without vibration.
/// @param node    of each model node (x, y [m/s], rotation [rad/s])
/// @param member  angular velocity of each member [rad/s]
[[nodiscard]] PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                                           const Eigen::MatrixX3d& node,
                                                           const VectorXd& member);

}  // namespace trammel::solver::large_motion
