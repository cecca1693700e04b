#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/input/document.h"
#include "harness/scene/case_model.h"

namespace trammel::harness {

/// One effect in a case, and why it is there or not.
struct EffectReason {
  solver::Effect effect{};
  bool applicable = false;  ///< what the parts and the analysis have at all
  bool active = false;
  std::optional<double> number;  ///< dimensionless; `describe_effect_number` says of what
  std::optional<double> change;  ///< of the results, relative, without it beside what went before
  std::string why;
};

/// What came of a case's "effects".
struct EffectChoice {
  solver::Effects chosen = solver::Effects::all();
  std::optional<double> tolerance;    ///< of "auto"
  std::vector<EffectReason> reasons;  ///< of every effect; empty where the analysis knows none
  solver::Counters counters;          ///< what the choice has cost
  /// At most what geometric stiffening and large displacement change, where no tier can compute
  /// them for the scene; relative.
  std::optional<double> beyond_tier;
};

/// Whether the case's analysis knows effects.
[[nodiscard]] bool knows_effects(const Document& document);

/// What the analysis of the whole scene can do with.
[[nodiscard]] EffectScope effect_scope(const Document& document, const CaseModel& case_model);

/// Reads "effects": names, or {"auto": {"tolerance": ...}}; without it, what the words of the parts
/// and of the analysis say. `case_model` is the whole scene, with all effects.
/// @throws InputError  for an effect that the scene does not admit.
[[nodiscard]] EffectChoice choose_effects(const Document& document, const CaseModel& case_model);

/// What an effect's dimensionless number is.
[[nodiscard]] std::string describe_effect_number(solver::Effect effect,
                                                 const std::string& analysis);

/// The case with these effects asked for by name.
[[nodiscard]] Document with_effects(const Document& document, solver::Effects effects);

}  // namespace trammel::harness
