#pragma once

#include <cstdint>

#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// Adds the evaluations of the elements of so many tangents, by effect.
/// @param moving  with the masses
void count_tangents(const large_motion::GeometricallyExactSystem& system, std::int64_t tangents,
                    bool moving, Counters& counters);

/// Statics in the geometrically exact tier (solver/large_motion). The load is put on in steps of
/// automatic size.
/// not_converged: the path of equilibria does not reach the load.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] StaticSolution solve_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

/// The same to six digits and without evidence: by corrections with the tangent of the model
/// without loads where these shrink fast and change no stability, else as above.
[[nodiscard]] StaticSolution estimate_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

}  // namespace trammel::solver
