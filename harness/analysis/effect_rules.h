#pragma once

#include <array>
#include <vector>

#include "harness/scene/case_model.h"
#include "solver/model/effects.h"

/// Rules for the selection of physical effects: applicable and required effects of each analysis.
namespace trammel::harness {

/// Key of an analysis by which the user switches an effect on or off.
struct EffectKey {
  solver::Effect effect;
  std::vector<const char*> place;  ///< path of the key below the analysis
  bool otherwise;                  ///< value if the key is absent
};

/// Effects that are applicable to an analysis, and effects that the analysis requires.
struct EffectScope {
  solver::Effects applicable, required;
  /// For each effect, its dependents, which are meaningless without the effect. In statics, the
  /// mass of links is a dependent of gravity.
  std::array<solver::Effects, solver::kEffectCount> dependents{};
  /// Reason why the options or the model exclude large displacement; null if large displacement is
  /// possible.
  const char* no_large_displacement = nullptr;

  /// Adds gyroscopic forces to a set of effects with large displacement and inertia, which imply
  /// gyroscopic forces.
  [[nodiscard]] solver::Effects with_implied_effects(solver::Effects set) const;
  /// Returns a set of effects without `effect` and without the effects that depend on it.
  [[nodiscard]] solver::Effects remove_with_dependents(solver::Effects set,
                                                       solver::Effect effect) const;
};

/// Rules of one analysis for the selection of effects. The parameter `analysis` is the JSON object
/// with the keys of the analysis.
struct EffectRules {
  std::vector<EffectKey> (*keys)(const JsonView& analysis);
  EffectScope (*scope)(const JsonView& analysis, const solver::Model& model);
  /// Column of the analysis in the table of reasons why effects are not applicable.
  std::size_t column;

  /// Returns the reason why an effect is not applicable.
  [[nodiscard]] const char* reason_not_applicable(solver::Effect effect) const;
};

/// Returns the formula of an effect's dimensionless number; empty if the effect has no number.
[[nodiscard]] const char* dimensionless_number_formula(solver::Effect effect);
/// Returns the reason why an effect is required.
[[nodiscard]] const char* reason_why_effect_is_required(solver::Effect effect);

extern const EffectRules kStaticsEffects, kModesEffects, kElastodynamicsEffects, kHarmonicEffects,
    kTransientEffects, kLargeMotionEffects;

/// Returns the model of a case at the start of its path, without line springs and follower loads.
[[nodiscard]] solver::Model model_at_path_start(const CaseModel& case_model);

/// Returns the effects that depend on an effect and are meaningless without it.
[[nodiscard]] solver::Effects& dependent_effects(EffectScope& scope, solver::Effect effect);

}  // namespace trammel::harness
