#pragma once

#include "solver/model/effects.h"
#include "solver/model/model.h"

/// Effects are taken out of a model before anything is assembled from it.
namespace trammel {

/// The effects that the parts have, as they are described. What belongs to an analysis rather than
/// to parts (inertia, damping, gyroscopic forces, geometric stiffening, large displacement) is not
/// among them.
[[nodiscard]] Effects admitted_effects(const Model& model);

/// The model without the effects that are not in `kept`.
[[nodiscard]] Model reduced(Model model, Effects kept);

}  // namespace trammel
