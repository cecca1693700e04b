#include "harness/analysis/case_effects.h"

#include <cmath>

#include "harness/analysis/analysis.h"
#include "harness/analysis/registry.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

const EffectRules* find_effect_rules(const Document& document) {
  return find_analysis(analysis_kind(document)).effects;
}

JsonView analysis_view(const Document& document) {
  return JsonView(document)["analysis"][analysis_kind(document)];
}

/// Returns the value of the analysis key that switches a physical effect on or off; empty if the
/// key is absent.
std::optional<JsonView> find_key(const Document& document, const EffectKey& effect_key) {
  std::optional<JsonView> place = analysis_view(document);
  for (const char* key : effect_key.place)
    if (place) place = place->find(key);
  return place;
}

/// Returns the physical effects of a case without the key "effects". Other keys of the model and of
/// the analysis switch these effects on or off.
Effects effects_of_keys(const Document& document, const EffectScope& scope) {
  Effects stated = scope.applicable;
  if (!scope.required.has(Effect::large_displacement))
    stated = stated.without(Effect::large_displacement);
  for (const EffectKey& effect_key : find_effect_rules(document)->keys(analysis_view(document))) {
    const auto specified = find_key(document, effect_key);
    if (specified ? specified->get<bool>() : effect_key.otherwise) continue;
    stated = scope.remove_with_dependents(stated, effect_key.effect);
  }
  return stated;
}

const char* reason_not_applicable(Effect effect, const EffectScope& scope,
                                  const EffectRules& rules) {
  const bool known = effect == Effect::large_displacement && scope.no_large_displacement != nullptr;
  return known ? scope.no_large_displacement : rules.reason_not_applicable(effect);
}

/// Returns one table row per effect, with its state (applicable, active) and the reason for this
/// state.
/// @param reason  reason for the state of effects that are applicable but not required
std::vector<results::EffectRow> effect_rows(const EffectScope& scope, Effects chosen,
                                            const EffectRules& rules, const std::string& reason) {
  std::vector<results::EffectRow> rows;
  for (const Effect effect : Effects::all().list()) {
    results::EffectRow& row = rows.emplace_back();
    row.name = solver::name_of(effect);
    row.applicable = scope.applicable.has(effect);
    row.active = row.applicable && chosen.has(effect);
    row.why = !row.applicable              ? reason_not_applicable(effect, scope, rules)
              : scope.required.has(effect) ? reason_why_effect_is_required(effect)
              : row.active                 ? reason
                                           : "not " + reason;
  }
  return rows;
}

/// Returns the required effects and the effects in the list `names`, which satisfies the schema.
Effects read_effects(const JsonView& names, const EffectScope& scope, const EffectRules& rules) {
  Effects chosen = scope.required;
  for (const auto& [number, place] : names.entries()) {
    const auto effect = solver::find_effect(place.get<std::string>());
    if (!scope.applicable.has(*effect))
      throw place.error("this effect is not applicable ('" + std::string(solver::name_of(*effect)) +
                        "': " + reason_not_applicable(*effect, scope, rules) + ")");
    chosen = chosen.with(*effect);
  }
  for (const Effect effect : chosen.list())
    for (const Effect carrier : scope.applicable.list()) {
      const bool carried = scope.dependents[static_cast<std::size_t>(carrier)].has(effect);
      if (carried && !chosen.has(carrier))
        throw names.error("expected '" + std::string(solver::name_of(carrier)) + "' too: '" +
                          std::string(solver::name_of(effect)) + "' requires this effect");
    }
  if (!(scope.with_implied_effects(chosen) == chosen))
    throw names.error(
        "expected 'gyroscopic' in the list: 'large-displacement' with 'inertia' includes it");
  return chosen;
}

std::string describe_effect_decision(Effect effect, const EffectScope& scope,
                                     const EffectSelection& selection, double tolerance) {
  const EffectEvidence& evidence = selection.evidence[static_cast<std::size_t>(effect)];
  const bool is_chosen = selection.chosen.has(effect);
  const std::optional<double> change = evidence.cumulative;
  if (change && std::isfinite(*change)) {
    const bool alone = evidence.own == evidence.cumulative;
    return "removing this effect " +
           std::string(alone ? "" : "in addition to those already removed ") +
           "changes the results by " + (evidence.is_measured ? "" : "at most ") + percent(*change) +
           (is_chosen ? ", above tolerance " : ", within tolerance ") + percent(tolerance);
  }
  if (change) return "the results have no meaning without this effect";
  for (const Effect dependent : scope.dependents[static_cast<std::size_t>(effect)].list())
    if (selection.chosen.has(dependent))
      return "required by " + std::string(solver::name_of(dependent));
  if (!is_chosen) return "removed together with an effect that it depends on";
  return is_expensive(effect) ? "kept: measuring the effect costs more time than removing it saves"
                              : "kept: the effect changes only matrix entries and costs no time";
}

EffectChoice choose_effects_automatically(const Document& document, const CaseModel& case_model,
                                          const EffectScope& scope, double tolerance) {
  const AnalysisKind& kind = find_analysis(analysis_kind(document));
  EffectChoice choice;
  choice.tolerance = tolerance;
  const EffectSelection& selection = choice.automatic.emplace(
      select_effects(kind, analysis_view(document), case_model, scope, tolerance));
  choice.chosen = selection.chosen;
  choice.rows = effect_rows(scope, choice.chosen, *kind.effects, "");
  for (const Effect effect : scope.applicable.list()) {
    const EffectEvidence& evidence = selection.evidence[static_cast<std::size_t>(effect)];
    results::EffectRow& row = choice.rows[static_cast<std::size_t>(effect)];
    row.dimensionless_number = evidence.number;
    if (evidence.number) row.number_definition = dimensionless_number_formula(effect);
    if (scope.required.has(effect)) continue;
    row.own_change = evidence.own;
    row.cumulative_change = evidence.cumulative;
    row.why = selection.outcome.solved()
                  ? describe_effect_decision(effect, scope, selection, tolerance)
                  : "kept: the coarse mesh has no solution (" + selection.outcome.reason + ")";
  }
  if (selection.beyond_tier)
    choice.rows[static_cast<std::size_t>(Effect::large_displacement)].why +=
        "; it would change the results by " + percent(*selection.beyond_tier);
  return choice;
}

}  // namespace

bool supports_effects(const Document& document) {
  return find_effect_rules(document) != nullptr;
}

EffectScope effect_scope(const Document& document, const CaseModel& case_model) {
  const solver::Model model = model_at_path_start(case_model);
  EffectScope scope = find_effect_rules(document)->scope(analysis_view(document), model);
  if (!model.triangles.empty()) {
    scope.applicable = scope.applicable.with(Effect::platform_flexibility);
    // Plates that do not belong to a platform always remain flexible.
    if (!case_model.manipulator || !case_model.structure.triangles.empty())
      scope.required = scope.required.with(Effect::platform_flexibility);
  }
  return scope;
}

EffectChoice choose_effects(const Document& document, const CaseModel& case_model) {
  const auto requested = JsonView(document).find("effects");
  if (!supports_effects(document)) {
    if (requested)
      throw requested->error("this analysis does not support 'effects'; expected " +
                             analyses_with_effects());
    return {};
  }
  const EffectRules& rules = *find_effect_rules(document);
  const EffectScope scope = effect_scope(document, case_model);
  EffectChoice choice;
  if (!requested) {
    choice.chosen = effects_of_keys(document, scope);
    choice.rows = effect_rows(scope, choice.chosen, rules, "specified by model and analysis");
    return choice;
  }
  for (const EffectKey& effect_key : find_effect_rules(document)->keys(analysis_view(document))) {
    const auto specified = find_key(document, effect_key);
    if (!specified) continue;
    throw specified->error("'effects' excludes this key, which specifies the same effect: " +
                           std::string(solver::name_of(effect_key.effect)));
  }
  if (requested->json().is_object())
    return choose_effects_automatically(document, case_model, scope,
                                        (*requested)["auto"].number("tolerance"));
  choice.chosen = read_effects(*requested, scope, rules);
  choice.rows = effect_rows(scope, choice.chosen, rules, "requested");
  return choice;
}

Document apply_effects(const Document& document, Effects effects) {
  Document changed = document;
  Json names = Json::array();
  for (const Effect effect : effects.list()) names.push_back(std::string(solver::name_of(effect)));
  Json patch = {{"effects", names}};
  for (const EffectKey& effect_key : find_effect_rules(document)->keys(analysis_view(document))) {
    std::string pointer = "/analysis/" + analysis_kind(document);
    const bool below =
        effect_key.place.size() > 1;  // a nested key must not create its parent object
    if (below && !find_key(document, effect_key)) continue;
    for (const char* key : effect_key.place) pointer += std::string("/") + key;
    patch[JsonPointer(pointer)] = nullptr;
  }
  changed.apply_patch(document.origin("").file, "", patch);
  return changed;
}

}  // namespace trammel::harness
