#pragma once

#include <vector>

#include "solver/effects/effect_estimates.h"
#include "solver/modes/rotating_modes.h"

namespace trammel::solver {

/// Modes of a frame that rotates steadily, from the whole ones: with x^H of the complex shape,
///   Q(w) = K + K_G - W^2 S + 2 i w W G - w^2 M, Q(w) x = 0, a part R of Q left out changes w by
///   x^H R x / (x^H Q'(w) x); half of it for Coriolis forces, which count by their square.
///   Source: P. Lancaster, Lambda-Matrices and Vibrating Systems (1966).
/// Flexibilities and masses by their shares of the energies, as in modes at rest.
/// @param speeds  [rad/s]
[[nodiscard]] EffectEstimates estimate_rotating_effects(const Model& model, Effects applicable,
                                                        const RotatingOptions& options,
                                                        const std::vector<double>& speeds);

}  // namespace trammel::solver
