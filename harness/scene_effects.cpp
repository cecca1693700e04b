#include "harness/scene_effects.h"

#include <algorithm>

#include "harness/analysis.h"
#include "harness/table.h"
#include "harness/words.h"

namespace trammel {
namespace {

Effects& carried_by(EffectScope& scope, Effect effect) {
  return scope.carries[static_cast<std::size_t>(effect)];
}

/// The word of an analysis that means geometric stiffening.
const char* stiffening_word(const std::string& kind) {
  return kind == "statics" ? "second_order" : "prestressed";
}

EffectScope statics_scope(const Model& model) {
  EffectScope scope;
  scope.admitted = admitted_effects(model).without(Effect::rotary_inertia);
  if (!scope.admitted.has(Effect::gravity)) {
    scope.admitted = scope.admitted.without(Effect::link_mass);
  }
  scope.admitted =
      scope.admitted.with(Effect::geometric_stiffening).with(Effect::large_displacement);
  carried_by(scope, Effect::gravity) = Effects().with(Effect::link_mass);
  const Effects large = Effects().with(Effect::large_displacement);
  carried_by(scope, Effect::geometric_stiffening) = large;
  if (would_be_overheld(model)) carried_by(scope, Effect::axial_flexibility) = large;
  return scope;
}

bool is_loaded(const Model& model) {
  const bool on_members = std::any_of(model.members.begin(), model.members.end(),
                                      [](const Member& m) { return !m.load.isZero(0); });
  return on_members || !model.loads.empty() || !model.edge_loads.empty();
}

EffectScope modes_scope(const Model& model) {
  EffectScope scope;
  scope.admitted = admitted_effects(model).with(Effect::inertia);
  scope.required = Effects().with(Effect::inertia);
  if (is_loaded(model) || scope.admitted.has(Effect::gravity)) {
    scope.admitted = scope.admitted.with(Effect::geometric_stiffening);
  }
  carried_by(scope, Effect::link_mass) = Effects().with(Effect::rotary_inertia);
  carried_by(scope, Effect::geometric_stiffening) = Effects().with(Effect::gravity);
  return scope;
}

/// Without "effects": the parts' own words, and the analysis's.
Effects stated_effects(const Document& document, const EffectScope& scope) {
  const std::string kind = analysis_kind(document);
  const bool second = Cursor(document)["analysis"][kind].get(stiffening_word(kind), false);
  Effects stated = scope.admitted.without(Effect::large_displacement);
  if (second) return stated;
  stated = stated.without(Effect::geometric_stiffening);
  return kind == "modes" ? stated.without(Effect::gravity) : stated;
}

/// Why a scene does not have an effect.
std::string missing_words(Effect effect, const std::string& kind) {
  switch (effect) {
    case Effect::axial_flexibility:
      return "no member both bends and stretches ('axial')";
    case Effect::shear:
      return "the members do not shear ('beam')";
    case Effect::rotary_inertia:
      return kind == "statics" ? "nothing moves in statics"
                               : "the sections have no rotary inertia ('beam')";
    case Effect::platform_flexibility:
      return "there is no platform of triangles ('kind')";
    case Effect::joint_compliance:
      return "no joint has a spring";
    case Effect::link_mass:
      return kind == "statics" ? "no member has a weight" : "no member has a mass";
    case Effect::gravity:
      return "nothing has a weight ('gravity_m_s2')";
    case Effect::inertia:
      return "nothing moves in statics";
    case Effect::geometric_stiffening:
      return "there are no loads";
    case Effect::large_displacement:
      return "modes are small motions";
  }
  return "";
}

std::string percent(double share) {
  return rounded(100 * share, 3) + " %";
}

std::vector<EffectReason> plain_reasons(const EffectScope& scope, Effects chosen,
                                        const std::string& kind, const std::string& word) {
  std::vector<EffectReason> reasons;
  for (const Effect effect : Effects::all().list()) {
    EffectReason one;
    one.effect = effect;
    one.admitted = scope.admitted.has(effect);
    one.on = one.admitted && chosen.has(effect);
    one.why = !one.admitted                ? missing_words(effect, kind)
              : scope.required.has(effect) ? "the analysis is of it"
              : one.on                     ? word
                                           : "not " + word;
    reasons.push_back(std::move(one));
  }
  return reasons;
}

/// Names, which the schema has checked.
Effects read_names(const Cursor& names, const EffectScope& scope, const std::string& kind) {
  Effects chosen = scope.required;
  for (const auto& [number, place] : names.entries()) {
    const auto effect = effect_named(place.get<std::string>());
    if (!scope.admitted.has(*effect)) {
      throw place.error("expected an effect that the scene admits (got '" +
                        std::string(name_of(*effect)) + "': " + missing_words(*effect, kind) + ")");
    }
    chosen = chosen.with(*effect);
  }
  for (const Effect effect : chosen.list()) {
    for (const Effect carrier : scope.admitted.list()) {
      const bool carried = scope.carries[static_cast<std::size_t>(carrier)].has(effect);
      if (carried && !chosen.has(carrier)) {
        throw names.error("expected '" + std::string(name_of(carrier)) + "' beside '" +
                          std::string(name_of(effect)) + "', which is nothing without it");
      }
    }
  }
  return chosen;
}

/// The whole model at a few of its poses, on a mesh that is good enough to decide by.
std::vector<Model> sample_poses(const Scene& scene) {
  constexpr std::size_t kPoses = 4;
  constexpr Index kElements = 8;
  const std::size_t count = std::min(kPoses, scene.steps());
  std::vector<Model> models;
  for (std::size_t i = 0; i < count; ++i) {
    models.push_back(build_model(scene, i * scene.steps() / count));
    for (Member& member : models.back().members) {
      member.elements = std::min(member.elements, kElements);
    }
  }
  return models;
}

std::string why_words(const EffectEstimate& estimate, bool on, double tolerance,
                      const EffectScope& scope, Effects chosen) {
  const std::string alone = percent(estimate.size());
  if (!on) {
    return "without it the results change by " + alone + ", within " + percent(tolerance) +
           (estimate.size() > 0 ? " together with all that is off" : "");
  }
  for (const Effect carried : scope.carries[static_cast<std::size_t>(estimate.effect)].list()) {
    if (chosen.has(carried) && estimate.size() < tolerance) {
      return std::string(name_of(carried)) + " needs it";
    }
  }
  if (estimate.size() > tolerance) {
    return "without it the results change by " + alone + ", more than " + percent(tolerance);
  }
  return "without it the results change by " + alone + ", with all that is off by more than " +
         percent(tolerance) + " less a tenth in hand";
}

EffectChoice choose_automatically(const Document& document, const Scene& scene,
                                  const EffectScope& scope, double tolerance) {
  const std::string kind = analysis_kind(document);
  const std::vector<Model> poses = sample_poses(scene);
  const Cursor analysis = Cursor(document)["analysis"][kind];
  const EffectEstimates estimates =
      kind == "statics"
          ? estimate_static_effects(poses, scope.admitted)
          : estimate_modal_effects(poses, scope.admitted, analysis["count"].get<Index>());
  EffectChoice choice;
  choice.tolerance = tolerance;
  choice.counters = estimates.counters;
  choice.chosen = choose_effects(estimates, scope, tolerance);
  choice.reasons = plain_reasons(
      scope, choice.chosen, kind,
      "decided: there is no linear solution to decide by (" + estimates.outcome.reason + ")");
  if (!estimates.outcome.solved()) return choice;
  for (const EffectEstimate& estimate : estimates.effects) {
    EffectReason& one = choice.reasons[static_cast<std::size_t>(estimate.effect)];
    if (scope.required.has(estimate.effect)) continue;
    one.number = estimate.number;
    one.change = estimate.size();
    one.why = why_words(estimate, one.on, tolerance, scope, choice.chosen);
  }
  return choice;
}

}  // namespace

bool knows_effects(const Document& document) {
  const std::string kind = analysis_kind(document);
  // A rotating frame turns with its forces and always stiffens by them.
  const bool rotating = Cursor(document)["analysis"][kind].has("rotating");
  return kind == "statics" || (kind == "modes" && !rotating);
}

EffectScope effect_scope(const Document& document, const Scene& scene) {
  const Model model = build_model(scene, 0);
  EffectScope scope =
      analysis_kind(document) == "statics" ? statics_scope(model) : modes_scope(model);
  if (!model.triangles.empty()) {
    scope.admitted = scope.admitted.with(Effect::platform_flexibility);
    // Plates that are no platform are what there is.
    if (!scene.manipulator) scope.required = scope.required.with(Effect::platform_flexibility);
  }
  return scope;
}

EffectChoice choose_effects(const Document& document, const Scene& scene) {
  const auto asked = Cursor(document).find("effects");
  if (!knows_effects(document)) {
    if (asked) throw asked->error("expected an analysis that knows effects: statics or modes");
    return {};
  }
  const std::string kind = analysis_kind(document);
  const EffectScope scope = effect_scope(document, scene);
  EffectChoice choice;
  if (!asked) {
    choice.chosen = stated_effects(document, scope);
    choice.reasons = plain_reasons(scope, choice.chosen, kind, "stated by the parts");
    return choice;
  }
  const Cursor analysis = Cursor(document)["analysis"][kind];
  const char* word = stiffening_word(kind);
  if (analysis.has(word)) {
    throw analysis[word].error("expected 'effects' alone to say it: geometric-stiffening");
  }
  if (asked->json().is_object()) {
    return choose_automatically(document, scene, scope, (*asked)["auto"].number("tolerance"));
  }
  choice.chosen = read_names(*asked, scope, kind);
  choice.reasons = plain_reasons(scope, choice.chosen, kind, "asked for");
  return choice;
}

std::string number_words(Effect effect, const std::string& analysis) {
  const bool statics = analysis == "statics";
  switch (effect) {
    case Effect::axial_flexibility:
      return statics ? "(r / L)^2, the squared slenderness" : "share of the strain energy";
    case Effect::shear:
      return statics ? "12 E I / (kappa G A L^2)" : "share of the strain energy";
    case Effect::platform_flexibility:
    case Effect::joint_compliance:
      return "share of the strain energy";
    case Effect::rotary_inertia:
      return "share of the kinetic energy";
    case Effect::link_mass:
      return statics ? "weight of members over all loads, in energy"
                     : "share of the kinetic energy";
    case Effect::gravity:
      return statics ? "other weights over all loads, in energy" : "share of the stiffness";
    case Effect::geometric_stiffening:
      return statics ? "load over buckling load, tension positive" : "share of the stiffness";
    case Effect::large_displacement:
      return "largest rotation [rad]";
    case Effect::inertia:
      break;
  }
  return "";
}

Document with_effects(const Document& document, Effects effects) {
  Document changed = document;
  Json names = Json::array();
  for (const Effect effect : effects.list()) names.push_back(std::string(name_of(effect)));
  const std::string kind = analysis_kind(document);
  changed.lay(document.origin("").file, "",
              Json{{"effects", names}, {"analysis", {{kind, {{stiffening_word(kind), nullptr}}}}}});
  return changed;
}

}  // namespace trammel
