#pragma once

#include "solver/elastodynamics/moving_system.h"
#include "solver/model/numbers.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// Balance of all forces, and of all moments, on the whole: the largest residual and the largest
/// sum of magnitudes over the samples [N], [N m]. Rows of the equation of motion are held to terms
/// that include the rounding of a very stiff part; this balance has no such terms.
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

}  // namespace trammel::solver
