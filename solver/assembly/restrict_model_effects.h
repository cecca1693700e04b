#pragma once

#include "solver/model/effects.h"
#include "solver/model/model.h"

/// Effects are taken out of a model before anything is assembled from it.
namespace trammel::solver {

/// The effects that the parts have, as they are described. What belongs to an analysis rather than
/// to parts (inertia, damping, gyroscopic forces, geometric stiffening, large displacement) is not
/// among them.
[[nodiscard]] Effects applicable_effects(const Model& model);

/// The model without the effects that are not in `active`.
[[nodiscard]] Model restrict_effects(Model model, Effects active);

}  // namespace trammel::solver
