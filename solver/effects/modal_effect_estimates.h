#pragma once

#include "solver/effects/effect_estimates.h"

namespace trammel::solver {

/// By modes: with x^T M x = 1 and the share e of the strain energy or k of the kinetic energy: a
/// flexibility left out changes the frequency by (1 - e)^(-1/2) - 1 (springs in series), an inertia
/// by (1 - k)^(-1/2) - 1, a geometric stiffness with the share g by (1 - g)^(1/2) - 1.
///   Source: Rayleigh, The Theory of Sound (1894), arts. 88-90.
/// @param poses  the full model at one pose or more, of the same parts
/// @param applicable  the effects to estimate
/// @param count  modes, from the lowest
[[nodiscard]] EffectEstimates estimate_modal_effects(const std::vector<Model>& poses,
                                                     Effects applicable, Index count);

}  // namespace trammel::solver
