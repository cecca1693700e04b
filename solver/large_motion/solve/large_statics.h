#pragma once

#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/statics/statics.h"

namespace trammel {

/// A state of large motion in the terms of `solve_statics`: displacements, end rotations,
/// reactions, and section forces along the axes that the sections have turned to.
[[nodiscard]] StaticSolution static_solution(const large::GeometricallyExactSystem& system,
                                             const large::State& state);

/// Statics in the geometrically exact tier (solver/large_motion). The whole load is put on in steps
/// that find themselves.
/// not_converged: the path of equilibria does not reach the load.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] StaticSolution solve_large_statics(const Model& model,
                                                 const large::LargeMotionModel& large_motion = {});

}  // namespace trammel
