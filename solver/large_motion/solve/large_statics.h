#pragma once

#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// A state of large motion in the terms of `solve_statics`: displacements, end rotations,
/// reactions, and section forces along the axes that the sections have turned to.
[[nodiscard]] StaticSolution static_solution(const large_motion::GeometricallyExactSystem& system,
                                             const large_motion::State& state);

/// Statics in the geometrically exact tier (solver/large_motion). The whole load is put on in steps
/// that find themselves.
/// not_converged: the path of equilibria does not reach the load.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] StaticSolution solve_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

}  // namespace trammel::solver
