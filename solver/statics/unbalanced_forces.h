#pragma once

#include <Eigen/Core>

#include "solver/statics/postprocessing.h"

namespace trammel::solver {

/// Equilibrium of what is reported: section forces at the ends of members, forces of springs and
/// triangles, reactions, forces of the other constraints, and the loads on nodes, at every
/// coordinate; the largest sum over `terms` there. Small also where the equation was not solved: it
/// tells whether the forces are those of the state.
/// @param terms  sums of the magnitudes of K u and the loads on the unconstrained coordinates
[[nodiscard]] double unbalanced_forces(const System& system, const ElasticState& state,
                                       const StaticSolution& solution,
                                       const Eigen::VectorXd& terms);

}  // namespace trammel::solver
