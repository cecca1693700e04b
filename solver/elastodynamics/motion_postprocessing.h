#pragma once

#include "solver/elastodynamics/moving_system.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// Displacements, reactions, section forces and stresses of the elastic motion at one pose, in
/// equilibrium with inertia and damping. A member's stress is the largest at the ends of its
/// elements.
/// @param q  free coordinates;  @param forces  of the same motion
[[nodiscard]] StaticSolution postprocess_motion(const MovingSystem& moving,
                                                const Eigen::VectorXd& q,
                                                const MovingSystem::Forces& forces);

/// Rotation that best fits the displacements of C1 C2 C3 [rad].
/// @param displacement  model node x (ux, uy [m], rotation [rad])
[[nodiscard]] double mean_platform_rotation(const MovingSystem& moving,
                                            const Eigen::MatrixX3d& displacement);

}  // namespace trammel::solver
