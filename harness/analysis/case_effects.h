#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/analysis/effect_selection.h"
#include "harness/input/document.h"
#include "harness/results/run_results.h"
#include "harness/scene/case_model.h"

namespace trammel::harness {

/// Physical effects, such as rotary inertia, with which a case is computed.
struct EffectChoice {
  solver::Effects chosen = solver::Effects::all();
  /// Tolerance of the automatic selection; empty if effects are not selected automatically.
  std::optional<double> tolerance;
  /// One row per physical effect, with its state (applicable, active); empty if the analysis has no
  /// selectable effects.
  std::vector<results::EffectRow> rows;
  std::optional<EffectSelection> automatic;  ///< result of the automatic selection of effects

  /// @returns true if the analysis cannot compute large displacement, although large displacement
  /// would change the results by more than the tolerance
  [[nodiscard]] bool is_beyond_linear_theory() const {
    return automatic && automatic->beyond_tier.value_or(0) > *tolerance;
  }
};

/// Returns true if the case's analysis supports the selection of effects.
[[nodiscard]] bool supports_effects(const Document& document);

/// Returns the effects that are applicable to a case, and the effects that the analysis of the case
/// requires.
[[nodiscard]] EffectScope effect_scope(const Document& document, const CaseModel& case_model);

/// Reads the key "effects" of a case: names, or {"auto": {"tolerance": ...}}. Without this key, the
/// effects follow from the keys of the model and of the analysis.
/// @param case_model  model of the case with all effects
/// @throws InputError  for an effect that is not applicable to the case.
[[nodiscard]] EffectChoice choose_effects(const Document& document, const CaseModel& case_model);

/// Returns the case with the key "effects" set to the names of the given effects.
[[nodiscard]] Document apply_effects(const Document& document, solver::Effects effects);

}  // namespace trammel::harness
