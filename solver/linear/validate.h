#pragma once

#include "solver/model/effects.h"
#include "solver/model/model.h"

namespace trammel::solver {

/// Checks what `assemble` relies on: indices inside their ranges, finite positions, positive
/// lengths, areas and stiffnesses.
/// @throws ModelError  one sentence that names the part and what is wrong with it.
void validate(const Model& model);

// Effects are taken out of a model before anything is assembled from it.

/// The effects that the parts have, as they are described. What belongs to an analysis rather than
/// to parts (inertia, damping, gyroscopic forces, geometric stiffening, large displacement) is not
/// among them.
[[nodiscard]] Effects applicable_effects(const Model& model);

/// The model without the effects that are not in `active`.
[[nodiscard]] Model restrict_effects(Model model, Effects active);

/// Whether the members, if they did not stretch, would be held more than once along themselves, as
/// a beam between two walls: their forces are then not determined, and the geometrically exact tier
/// has no solution, for a beam that bends between walls must stretch.
[[nodiscard]] bool is_axially_overconstrained(const Model& model);

}  // namespace trammel::solver
