#include <algorithm>

#include "solver/effects/effect_estimates.h"

namespace trammel {

Effects EffectScope::without(Effects set, Effect effect) const {
  set = set.without(effect);
  for (const Effect carried : carries[static_cast<std::size_t>(effect)].list()) {
    if (set.has(carried)) set = without(set, carried);
  }
  return set;
}

Effects choose_effects(const EffectEstimates& estimates, const EffectScope& scope,
                       double tolerance) {
  if (!estimates.outcome.solved()) return scope.admitted;
  constexpr double kInHand = 0.9;
  std::vector<const EffectEstimate*> candidates;
  for (const EffectEstimate& one : estimates.effects) {
    if (!scope.required.has(one.effect)) candidates.push_back(&one);
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const EffectEstimate* a, const EffectEstimate* b) { return a->size() < b->size(); });
  Effects kept = scope.admitted;
  Eigen::VectorXd lost;
  for (bool again = true; again;) {
    again = false;
    for (const EffectEstimate* one : candidates) {
      if (!kept.has(one->effect)) continue;
      // What it carries must go first.
      if (!(scope.without(kept, one->effect) == kept.without(one->effect))) continue;
      const Eigen::VectorXd with_it = lost.size() == 0 ? one->change : lost + one->change;
      const double change = with_it.size() > 0 ? with_it.cwiseAbs().maxCoeff() : 0;
      if (!(change <= kInHand * tolerance)) continue;
      kept = kept.without(one->effect);
      lost = with_it;
      again = true;
    }
  }
  return kept;
}

}  // namespace trammel
