#pragma once

#include "solver/elastodynamics/moving_system.h"
#include "solver/model/numbers.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// Balance of all forces, and of all moments, on the whole: the largest over the samples of what is
/// left and of the sum of magnitudes [N], [N m]. Rows of the equation of motion are held to terms
/// that rounding of a very stiff part belongs to; here that part has none.
struct WholeBalance {
  Vector2d residual = Vector2d::Zero(), terms = Vector2d::Zero();

  [[nodiscard]] double share() const {
    return nan_max(terms[0] > 0 ? residual[0] / terms[0] : 0,
                   terms[1] > 0 ? residual[1] / terms[1] : 0);
  }
};

/// Displacements, reactions, section forces and stresses of the elastic motion at one pose, in
/// equilibrium with inertia and damping. A member's stress is the largest at the ends of its
/// elements.
/// @param q  free coordinates;  @param forces  of the same motion;  @param balance  to add it to
[[nodiscard]] StaticSolution postprocess_motion(const MovingSystem& moving,
                                                const Eigen::VectorXd& q,
                                                const MovingSystem::Forces& forces,
                                                WholeBalance& balance);

/// Rotation that best fits the displacements of C1 C2 C3 [rad].
/// @param position  where they are without it, model node x (x, y) [m]
/// @param displacement  model node x (ux, uy [m], rotation [rad])
[[nodiscard]] double mean_platform_rotation(const Model& model, const Eigen::MatrixX2d& position,
                                            const Eigen::MatrixX3d& displacement);

}  // namespace trammel::solver
