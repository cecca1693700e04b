#pragma once

#include <optional>
#include <string>
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
  std::optional<double> tolerance;       ///< of "auto"
  std::vector<results::EffectRow> rows;  ///< of every effect; empty if the analysis has no effects
  std::optional<EffectSelection> automatic;  ///< of "auto"

  /// @returns whether large displacement, which the analysis cannot compute, exceeds the tolerance
  [[nodiscard]] bool is_beyond_tier() const {
    return automatic && automatic->beyond_tier.value_or(0) > *tolerance;
  }
};

/// Whether the case's analysis knows effects.
[[nodiscard]] bool knows_effects(const Document& document);

/// What the analysis of the whole scene can do with.
[[nodiscard]] EffectScope effect_scope(const Document& document, const CaseModel& case_model);

/// Reads "effects": names, or {"auto": {"tolerance": ...}}; without it, what the words of the parts
/// and of the analysis say. `case_model` is the whole scene, with all effects.
/// @throws InputError  for an effect that the scene does not admit.
[[nodiscard]] EffectChoice choose_effects(const Document& document, const CaseModel& case_model);

/// The case with these effects asked for by name.
[[nodiscard]] Document with_effects(const Document& document, solver::Effects effects);

}  // namespace trammel::harness
