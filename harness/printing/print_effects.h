#pragma once

#include <string>

#include "harness/analysis/case_effects.h"

namespace trammel::harness {

/// Prints the effects of a case; of automatic ones also numbers, changes and reasons.
void print_effects(const EffectChoice& choice);

/// "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(solver::Effects effects);

}  // namespace trammel::harness
