#include "solver/effects/effect_choice.h"

#include <algorithm>

namespace trammel::solver {

Effects EffectScope::without(Effects set, Effect effect) const {
  set = set.without(effect);
  for (const Effect dependent : dependents[static_cast<std::size_t>(effect)].list()) {
    if (set.has(dependent)) set = without(set, dependent);
  }
  return set;
}

Effects choose_effects(const EffectEstimates& estimates, const EffectScope& scope,
                       double tolerance) {
  if (!estimates.outcome.solved()) return scope.applicable;
  constexpr double kSafetyFactor = 0.9;
  std::vector<const EffectEstimate*> candidates;
  for (const EffectEstimate& estimate : estimates.effects) {
    if (!scope.required.has(estimate.effect)) candidates.push_back(&estimate);
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const EffectEstimate* a, const EffectEstimate* b) { return a->size() < b->size(); });
  Effects active = scope.applicable;
  Eigen::VectorXd total_change;
  for (bool removed = true; removed;) {
    removed = false;
    for (const EffectEstimate* estimate : candidates) {
      if (!active.has(estimate->effect)) continue;
      // What depends on it must go first.
      if (!(scope.without(active, estimate->effect) == active.without(estimate->effect))) continue;
      const Eigen::VectorXd trial_change =
          total_change.size() == 0 ? estimate->change : total_change + estimate->change;
      const double change = trial_change.size() > 0 ? trial_change.cwiseAbs().maxCoeff() : 0;
      if (!(change <= kSafetyFactor * tolerance)) continue;
      active = active.without(estimate->effect);
      total_change = trial_change;
      removed = true;
    }
  }
  return active;
}

}  // namespace trammel::solver
