#pragma once

#include "solver/model/model.h"

namespace trammel::solver {

/// Whether the members, if they did not stretch, would be held more than once along themselves, as
/// a beam between two walls: their forces are then not determined, and the geometrically exact tier
/// has no solution, for a beam that bends between walls must stretch.
[[nodiscard]] bool is_axially_overconstrained(const Model& model);

}  // namespace trammel::solver
