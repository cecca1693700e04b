#pragma once

#include <string>

#include "harness/analysis/case_effects.h"

namespace trammel::harness {

/// Prints, under its head, which effects a case has; where they are automatic, by which numbers and
/// why.
void print_effects(const EffectChoice& choice, const std::string& analysis);

/// "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(const std::vector<solver::Effect>& effects);

}  // namespace trammel::harness
