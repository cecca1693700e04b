#pragma once

#include <string>

#include "harness/analysis/case_effects.h"

namespace trammel {

/// Prints, under its head, which effects a case has; where they are automatic, by which numbers and
/// why.
void print_effects(const EffectChoice& choice, const std::string& analysis);

/// "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(Effects effects);

}  // namespace trammel
