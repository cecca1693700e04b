#pragma once

#include <array>
#include <optional>
#include <vector>

#include "harness/scene/case_model.h"
#include "solver/model/effects.h"

/// What the analyses that know effects can do with, how they decide, and what they say of it.
namespace trammel::harness {

/// A word of the analysis itself that says whether there is an effect.
struct EffectKey {
  solver::Effect effect;
  std::vector<const char*> place;  ///< below the analysis
  bool otherwise;                  ///< where nothing is said
};

/// What an analysis can do with, and what it cannot do without.
struct EffectScope {
  solver::Effects applicable, required;
  /// By effect: those that are nothing without it, as the mass of links in statics without gravity.
  std::array<solver::Effects, solver::kEffectCount> dependents{};
  /// Why large displacement is not applicable, where the analysis has it at all.
  const char* no_large_displacement = nullptr;

  /// With gyroscopic forces, where large displacement with inertia contains them.
  [[nodiscard]] solver::Effects completed(solver::Effects set) const;
  /// The set less the effect and all that depends on it.
  [[nodiscard]] solver::Effects without(solver::Effects set, solver::Effect effect) const;
};

/// `analysis` is the place below "analysis" that holds the analysis's own words.
struct EffectRules {
  std::vector<EffectKey> (*keys)(const JsonView& analysis);
  EffectScope (*scope)(const JsonView& analysis, const solver::Model& model);
  std::size_t column;  ///< in the table of words

  /// Reason for the absence of an effect in a scene.
  [[nodiscard]] const char* describe_missing(solver::Effect effect) const;
};

/// Definition of an effect's dimensionless number; empty if it has none.
[[nodiscard]] const char* describe_number(solver::Effect effect);
/// Reason for always keeping the effect.
[[nodiscard]] const char* describe_required(solver::Effect effect);

extern const EffectRules kStaticsEffects, kModesEffects, kElastodynamicsEffects, kHarmonicEffects,
    kTransientEffects, kLargeMotionEffects;

/// The scene's model where its path starts; of what only large motion has, the bare one.
[[nodiscard]] solver::Model first_model(const CaseModel& case_model);

/// The effects that an effect carries: without it they are nothing.
[[nodiscard]] solver::Effects& dependents_of(EffectScope& scope, solver::Effect effect);

}  // namespace trammel::harness
