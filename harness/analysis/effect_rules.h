#pragma once

#include <array>
#include <vector>

#include "harness/scene/case_model.h"
#include "solver/model/effects.h"

/// Rules for the selection of effects: the applicable and required effects of each analysis, and
/// reasons for them.
namespace trammel::harness {

/// Key of an analysis that switches an effect.
struct EffectKey {
  solver::Effect effect;
  std::vector<const char*> place;  ///< path of the key below the analysis
  bool otherwise;                  ///< value if the key is absent
};

/// Effects that apply to an analysis, and those that it requires.
struct EffectScope {
  solver::Effects applicable, required;
  /// For each effect, the effects that are meaningless without it: the mass of links in statics
  /// requires gravity.
  std::array<solver::Effects, solver::kEffectCount> dependents{};
  /// Reason why large displacement is not applicable; null if the analysis never has it.
  const char* no_large_displacement = nullptr;

  /// Adds gyroscopic forces to a set with large displacement and inertia, which contain them.
  [[nodiscard]] solver::Effects completed(solver::Effects set) const;
  /// Returns the set without the effect and without its dependents.
  [[nodiscard]] solver::Effects without(solver::Effects set, solver::Effect effect) const;
};

/// Functions of an analysis. Their parameter `analysis` is the object below "analysis" that holds
/// its keys.
struct EffectRules {
  std::vector<EffectKey> (*keys)(const JsonView& analysis);
  EffectScope (*scope)(const JsonView& analysis, const solver::Model& model);
  std::size_t column;  ///< column of the analysis in the table of reasons for absent effects

  /// Reason for the absence of an effect in a scene.
  [[nodiscard]] const char* describe_missing(solver::Effect effect) const;
};

/// Returns the definition of an effect's dimensionless number; empty if it has none.
[[nodiscard]] const char* describe_number(solver::Effect effect);
/// Returns the reason for always keeping the effect.
[[nodiscard]] const char* describe_required(solver::Effect effect);

extern const EffectRules kStaticsEffects, kModesEffects, kElastodynamicsEffects, kHarmonicEffects,
    kTransientEffects, kLargeMotionEffects;

/// Returns the scene's model at the start of its path. Line springs and follower loads are omitted.
[[nodiscard]] solver::Model first_model(const CaseModel& case_model);

/// Returns the effects that depend on an effect and are meaningless without it.
[[nodiscard]] solver::Effects& dependents_of(EffectScope& scope, solver::Effect effect);

}  // namespace trammel::harness
