#include "harness/analysis/case_effects.h"

#include <algorithm>
#include <limits>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_elimination.h"
#include "harness/analysis/registry.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

const EffectRules* effects_of(const Document& document) {
  return find_analysis(analysis_kind(document)).effects;
}

JsonView analysis_place(const Document& document) {
  return JsonView(document)["analysis"][analysis_kind(document)];
}

/// What the analysis says of it, if anything.
std::optional<JsonView> find_key(const Document& document, const EffectKey& effect_key) {
  std::optional<JsonView> place = analysis_place(document);
  for (const char* key : effect_key.place) {
    if (place) place = place->find(key);
  }
  return place;
}

/// Without "effects": the parts' own words, and the analysis's.
Effects stated_effects(const Document& document, const EffectScope& scope) {
  Effects stated = scope.applicable;
  if (!scope.required.has(Effect::large_displacement))
    stated = stated.without(Effect::large_displacement);
  for (const EffectKey& effect_key : effects_of(document)->keys(analysis_place(document))) {
    const auto specified = find_key(document, effect_key);
    if (specified ? specified->get<bool>() : effect_key.otherwise) continue;
    stated = scope.without(stated, effect_key.effect);
  }
  return stated;
}

const char* describe_missing(Effect effect, const EffectScope& scope, const EffectRules& rules) {
  const bool known = effect == Effect::large_displacement && scope.no_large_displacement != nullptr;
  return known ? scope.no_large_displacement : rules.describe_missing(effect);
}

std::vector<EffectReason> reasons_without_estimates(const EffectScope& scope, Effects chosen,
                                                    const EffectRules& rules,
                                                    const std::string& effect_key) {
  std::vector<EffectReason> reasons;
  for (const Effect effect : Effects::all().list()) {
    EffectReason one;
    one.effect = effect;
    one.applicable = scope.applicable.has(effect);
    one.active = one.applicable && chosen.has(effect);
    one.why = !one.applicable              ? describe_missing(effect, scope, rules)
              : scope.required.has(effect) ? rules.describe_required(effect)
              : one.active                 ? effect_key
                                           : "not " + effect_key;
    reasons.push_back(std::move(one));
  }
  return reasons;
}

/// Names, which the schema has checked.
Effects read_names(const JsonView& names, const EffectScope& scope, const EffectRules& rules) {
  Effects chosen = scope.required;
  for (const auto& [number, place] : names.entries()) {
    const auto effect = solver::effect_named(place.get<std::string>());
    if (!scope.applicable.has(*effect)) {
      throw place.error("expected an effect that the scene admits (got '" +
                        std::string(solver::name_of(*effect)) +
                        "': " + describe_missing(*effect, scope, rules) + ")");
    }
    chosen = chosen.with(*effect);
  }
  for (const Effect effect : chosen.list()) {
    for (const Effect carrier : scope.applicable.list()) {
      const bool carried = scope.dependents[static_cast<std::size_t>(carrier)].has(effect);
      if (carried && !chosen.has(carrier)) {
        throw names.error("expected '" + std::string(solver::name_of(carrier)) + "' beside '" +
                          std::string(solver::name_of(effect)) + "', which is nothing without it");
      }
    }
  }
  if (!(scope.completed(chosen) == chosen)) {
    throw names.error(
        "expected 'gyroscopic' beside 'large-displacement' and 'inertia', which contain it");
  }
  return chosen;
}

std::string describe_decision(const EffectReason& one, const EffectScope& scope,
                              const Elimination& found, double tolerance, bool estimated) {
  if (one.active && !found.chosen.has(one.effect)) return "large displacement contains it";
  if (one.change) {
    return "without it and what was left out before it the results change by " +
           std::string(estimated ? "at most " : "") + percent(*one.change) +
           (one.active ? ", more than " : ", within ") + percent(tolerance);
  }
  for (const Effect carried : scope.dependents[static_cast<std::size_t>(one.effect)].list()) {
    if (found.chosen.has(carried)) return std::string(solver::name_of(carried)) + " needs it";
  }
  return "decided";
}

/// Without the effects that cost most, as far as they are not chosen.
Effects without_costly(const EffectScope& scope, Effects chosen) {
  Effects whole = scope.applicable;
  for (const Effect effect : {Effect::large_displacement, Effect::inertia})
    if (!chosen.has(effect)) whole = scope.without(whole, effect);
  return whole;
}

/// By estimates, which add up; the smallest goes first. Where they come near the tolerance the
/// effect is measured if that costs little: a run of the whole scene would cost what no choice
/// could save.
Elimination eliminate_by_estimates(const Document& document, const CaseModel& case_model,
                                   solver::EffectEstimates& estimates, const EffectScope& scope,
                                   double tolerance, std::vector<EffectReason>& reasons) {
  constexpr double kBeyondFirstOrder = 1.25;
  /// Estimates are bounds: what is worth more than the tolerance is seldom put higher than this.
  constexpr double kNear = 3;
  std::ranges::stable_sort(estimates.effects,
                           [](const auto& a, const auto& b) { return a.change < b.change; });
  std::vector<Effect> order;
  for (const solver::EffectEstimate& one : estimates.effects) {
    order.push_back(one.effect);
    reasons[static_cast<std::size_t>(one.effect)].number = one.number;
  }
  const ChangeWith at_most = [&](Effects active) {
    const bool large = active.has(Effect::large_displacement);
    double change = 0;
    for (const solver::EffectEstimate& one : estimates.effects) {
      const bool kept = large && one.effect == Effect::gyroscopic;  // a part of that theory
      if (!active.has(one.effect) && !kept) change += one.change;
    }
    return kBeyondFirstOrder * change;
  };
  Elimination found;
  if (estimates.outcome.solved()) found = eliminate(scope, order, {}, tolerance, at_most);
  found.outcome = estimates.outcome;
  found.counters = estimates.counters;
  // What is saved pays for runs without it.
  const Effects cheap = without_costly(scope, found.chosen);
  const bool has_tier = scope.applicable.has(Effect::large_displacement);
  if (!found.outcome.solved() || !has_tier || cheap == scope.applicable) return found;
  std::vector<Effect> near;
  for (const solver::EffectEstimate& one : estimates.effects) {
    const bool removable = found.chosen.has(one.effect) && !scope.required.has(one.effect);
    if (removable && one.change <= kNear * tolerance) near.push_back(one.effect);
  }
  if (!near.empty())
    eliminate_near_tolerance(find_analysis(analysis_kind(document)), analysis_place(document),
                             case_model, scope, tolerance, near, {cheap, at_most(cheap)}, found);
  return found;
}

/// Large displacement, and geometric stiffening with it: by a bound, and where that does not settle
/// it, by what they are worth without vibration where the motion has its extremes.
void estimate_large_displacement(const JsonView& analysis, const CaseModel& case_model,
                                 double tolerance, solver::EffectEstimates& estimates) {
  double& change = estimates.large_displacement_bound;
  const auto of_motion = [&] {
    return estimates.large_displacement_growth * change + estimates.large_displacement_beside;
  };
  if (of_motion() > tolerance) {
    change =
        large_displacement_at_rest(analysis, case_model, estimates.extreme_times).value_or(change);
  }
  // Where linear theory is lost, it says nothing of the other effects.
  constexpr double kLost = 0.5;
  if (change > kLost) {
    for (solver::EffectEstimate& one : estimates.effects)
      one.change = std::numeric_limits<double>::infinity();
  }
  estimates.effects.push_back({Effect::large_displacement, change, of_motion()});
}

/// Estimates of loads that set in at once know what vibrates, not how it begins.
void add_changes_at_start(const JsonView& analysis, const CaseModel& case_model,
                          const EffectScope& scope, solver::EffectEstimates& estimates) {
  if (analysis.text("initial_state") == "quasi-static") return;
  std::vector<Effect> effects;
  for (const Effect effect : {Effect::shear, Effect::rotary_inertia, Effect::platform_flexibility,
                              Effect::joint_compliance, Effect::link_mass}) {
    if (scope.applicable.has(effect)) effects.push_back(effect);
  }
  const std::vector<double> changes = changes_at_start(analysis, case_model, scope, effects);
  for (solver::EffectEstimate& one : estimates.effects) {
    const auto found = std::ranges::find(effects, one.effect);
    if (found != effects.end())
      one.change = std::max(one.change, changes[static_cast<std::size_t>(found - effects.begin())]);
  }
}

/// What no analysis of this scene has.
void add_beyond_tier(const EffectScope& scope, double bound, EffectChoice& choice) {
  if (scope.applicable.has(Effect::large_displacement)) return;
  choice.beyond_tier = bound;
  EffectReason& one = choice.reasons[static_cast<std::size_t>(Effect::large_displacement)];
  one.change = bound;
  one.why += "; it would change at most " + percent(bound) + ", by rotation and buckling load";
}

EffectChoice choose_automatically(const Document& document, const CaseModel& case_model,
                                  const EffectScope& scope, double tolerance) {
  const AnalysisKind& kind = find_analysis(analysis_kind(document));
  const EffectRules& rules = *kind.effects;
  EffectChoice choice;
  choice.tolerance = tolerance;
  choice.reasons = reasons_without_estimates(scope, scope.applicable, rules, "decided");
  const JsonView analysis = analysis_place(document);
  solver::EffectEstimates estimates;
  if (rules.estimate != nullptr) {
    estimates = rules.estimate(analysis, case_model, scope);
    if (estimates.outcome.solved()) add_changes_at_start(analysis, case_model, scope, estimates);
    if (estimates.outcome.solved() && scope.applicable.has(Effect::large_displacement))
      estimate_large_displacement(analysis, case_model, tolerance, estimates);
  }
  const Elimination found =
      rules.estimate != nullptr
          ? eliminate_by_estimates(document, case_model, estimates, scope, tolerance,
                                   choice.reasons)
          : eliminate_by_measurement(kind, analysis, case_model, scope, tolerance);
  choice.counters = found.counters;
  choice.chosen = found.outcome.solved() ? scope.completed(found.chosen) : scope.applicable;
  for (EffectReason& one : choice.reasons) {
    if (!one.applicable || scope.required.has(one.effect)) continue;
    one.active = choice.chosen.has(one.effect);
    one.change = found.change[static_cast<std::size_t>(one.effect)];
    one.why =
        found.outcome.solved()
            ? describe_decision(one, scope, found, tolerance,
                                rules.estimate != nullptr && !found.measured.has(one.effect))
            : "on: the whole scene has no solution to compare with (" + found.outcome.reason + ")";
    if (rules.estimate == nullptr)
      one.number = slenderness_number(one.effect, first_model(case_model));
  }
  if (rules.estimate != nullptr && estimates.outcome.solved())
    add_beyond_tier(scope, estimates.large_displacement_bound, choice);
  return choice;
}

}  // namespace

bool knows_effects(const Document& document) {
  return effects_of(document) != nullptr;
}

EffectScope effect_scope(const Document& document, const CaseModel& case_model) {
  const solver::Model model = first_model(case_model);
  EffectScope scope = effects_of(document)->scope(analysis_place(document), model);
  if (!model.triangles.empty()) {
    scope.applicable = scope.applicable.with(Effect::platform_flexibility);
    // Plates that are no platform are what there is.
    if (!case_model.manipulator || !case_model.structure.triangles.empty())
      scope.required = scope.required.with(Effect::platform_flexibility);
  }
  return scope;
}

EffectChoice choose_effects(const Document& document, const CaseModel& case_model) {
  const auto requested = JsonView(document).find("effects");
  if (!knows_effects(document)) {
    if (requested)
      throw requested->error("expected an analysis that knows effects: " + analyses_with_effects());
    return {};
  }
  const EffectRules& rules = *effects_of(document);
  const EffectScope scope = effect_scope(document, case_model);
  EffectChoice choice;
  if (!requested) {
    choice.chosen = stated_effects(document, scope);
    choice.reasons = reasons_without_estimates(scope, choice.chosen, rules, "stated by the parts");
    return choice;
  }
  for (const EffectKey& effect_key : effects_of(document)->keys(analysis_place(document))) {
    const auto specified = find_key(document, effect_key);
    if (!specified) continue;
    throw specified->error("expected 'effects' alone to say it: " +
                           std::string(solver::name_of(effect_key.effect)));
  }
  if (requested->json().is_object()) {
    return choose_automatically(document, case_model, scope,
                                (*requested)["auto"].number("tolerance"));
  }
  choice.chosen = read_names(*requested, scope, rules);
  choice.reasons = reasons_without_estimates(scope, choice.chosen, rules, "asked for");
  return choice;
}

std::string describe_effect_number(Effect effect, const std::string& analysis) {
  return find_analysis(analysis).effects->describe_number(effect);
}

Document with_effects(const Document& document, Effects effects) {
  Document changed = document;
  Json names = Json::array();
  for (const Effect effect : effects.list()) names.push_back(std::string(solver::name_of(effect)));
  Json patch = {{"effects", names}};
  for (const EffectKey& effect_key : effects_of(document)->keys(analysis_place(document))) {
    std::string pointer = "/analysis/" + analysis_kind(document);
    const bool below =
        effect_key.place.size() > 1;  // what holds the word must not come from nothing
    if (below && !find_key(document, effect_key)) continue;
    for (const char* key : effect_key.place) pointer += std::string("/") + key;
    patch[JsonPointer(pointer)] = nullptr;
  }
  changed.apply_patch(document.origin("").file, "", patch);
  return changed;
}

}  // namespace trammel::harness
