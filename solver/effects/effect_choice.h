#pragma once

#include <array>

#include "solver/effects/effect_estimates.h"

namespace trammel::solver {

/// What an analysis can do with, and what it cannot do without.
struct EffectScope {
  Effects applicable;
  Effects required;
  /// By effect: those that are nothing without it, as the mass of links in statics without gravity.
  std::array<Effects, kEffectCount> dependents{};

  /// The set less the effect and all that depends on it.
  [[nodiscard]] Effects without(Effects set, Effect effect) const;
};

/// The smallest set, going by the estimates, whose joint change stays within nine tenths of the
/// tolerance: to second order the estimates err by their square and less.
[[nodiscard]] Effects choose_effects(const EffectEstimates& estimates, const EffectScope& scope,
                                     double tolerance);

}  // namespace trammel::solver
