#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/analysis/effect_selection.h"
#include "harness/input/document.h"
#include "harness/results/run_results.h"
#include "harness/scene/case_model.h"

namespace trammel::harness {

/// Effects of a case.
struct EffectChoice {
  solver::Effects chosen = solver::Effects::all();
  std::optional<double> tolerance;  ///< tolerance of the automatic selection
  /// State of every effect; empty if the analysis has no effects.
  std::vector<results::EffectRow> rows;
  std::optional<EffectSelection> automatic;  ///< result of the automatic selection

  /// @returns true if large displacement, which the analysis cannot compute, exceeds the tolerance
  [[nodiscard]] bool is_beyond_tier() const {
    return automatic && automatic->beyond_tier.value_or(0) > *tolerance;
  }
};

/// Returns true if the case's analysis supports the selection of effects.
[[nodiscard]] bool supports_effects(const Document& document);

/// Returns the effects that apply to the complete scene, and those that its analysis requires.
[[nodiscard]] EffectScope effect_scope(const Document& document, const CaseModel& case_model);

/// Reads "effects": names, or {"auto": {"tolerance": ...}}. Without this key, the effects follow
/// from the keys of the parts and of the analysis.
/// @param case_model  the complete scene, with all effects
/// @throws InputError  for an effect that is not applicable to the scene.
[[nodiscard]] EffectChoice choose_effects(const Document& document, const CaseModel& case_model);

/// Returns the case with "effects" set to the names of these effects.
[[nodiscard]] Document with_effects(const Document& document, solver::Effects effects);

}  // namespace trammel::harness
