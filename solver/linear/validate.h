#pragma once

#include "solver/model/effects.h"
#include "solver/model/model.h"

namespace trammel::solver {

/// Checks the requirements of `assemble` for a model: valid indices, finite positions, and positive
/// lengths, areas and stiffnesses.
/// @throws ModelError  with one sentence that names the object of the model and the problem.
void validate(const Model& model);

// Removal of inactive physical effects, such as gravity, from a model before its assembly.

/// Returns the effects that the properties of the model cause, such as shear or gravity. Effects
/// that only an analysis causes are not included: inertia, damping, gyroscopic forces, geometric
/// stiffening and large displacement.
[[nodiscard]] Effects applicable_effects(const Model& model);

/// Returns the model without the effects that are not in `active`.
[[nodiscard]] Model restrict_effects(Model model, Effects active);

/// Returns true if inextensible members would be overconstrained along their axes, as in a beam
/// between two walls. The axial forces of such members would be undetermined. A geometrically exact
/// analysis would have no solution, because a beam that bends between walls must stretch.
[[nodiscard]] bool is_axially_overconstrained(const Model& model);

}  // namespace trammel::solver
