#include "harness/analysis/case_effects.h"

#include <algorithm>

#include "harness/analysis/analysis.h"
#include "harness/analysis/analysis_kinds.h"
#include "harness/analysis/rotating_state.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/readers/time_reader.h"
#include "solver/assembly/restrict_model_effects.h"
#include "solver/effects/axial_constraints.h"
#include "solver/effects/dynamic_effect_estimates.h"
#include "solver/effects/modal_effect_estimates.h"
#include "solver/effects/rotating_effect_estimates.h"
#include "solver/effects/static_effect_estimates.h"

namespace trammel::harness {
namespace {

solver::Effects& carried_by(solver::EffectScope& scope, solver::Effect effect) {
  return scope.dependents[static_cast<std::size_t>(effect)];
}

/// A word of the analysis itself that says whether there is an effect.
struct EffectKey {
  solver::Effect effect;
  std::vector<const char*> place;  ///< below the analysis
  bool otherwise;                  ///< where nothing is said
};

bool is_rotating(const Document& document) {
  return JsonView(document)["analysis"][analysis_kind(document)].has("rotating");
}

std::vector<EffectKey> effect_keys(const Document& document) {
  const std::string kind = analysis_kind(document);
  if (kind == "statics") return {{solver::Effect::geometric_stiffening, {"second_order"}, false}};
  if (kind == "elastodynamics") {
    return {{solver::Effect::inertia, {"effects", "elastic_inertia"}, true},
            {solver::Effect::gyroscopic, {"effects", "transformation_rate_terms"}, false}};
  }
  if (is_rotating(document)) return {{solver::Effect::gyroscopic, {"rotating", "coriolis"}, true}};
  return {{solver::Effect::geometric_stiffening, {"prestressed"}, false}};
}

/// What the analysis says of it, if anything.
std::optional<JsonView> find_key(const Document& document, const EffectKey& effect_key) {
  std::optional<JsonView> place = JsonView(document)["analysis"][analysis_kind(document)];
  for (const char* key : effect_key.place) {
    if (place) place = place->find(key);
  }
  return place;
}

solver::EffectScope statics_scope(const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model).without(solver::Effect::rotary_inertia);
  if (!scope.applicable.has(solver::Effect::gravity)) {
    scope.applicable = scope.applicable.without(solver::Effect::link_mass);
  }
  scope.applicable = scope.applicable.with(solver::Effect::geometric_stiffening)
                         .with(solver::Effect::large_displacement);
  carried_by(scope, solver::Effect::gravity) = solver::Effects().with(solver::Effect::link_mass);
  const solver::Effects large = solver::Effects().with(solver::Effect::large_displacement);
  carried_by(scope, solver::Effect::geometric_stiffening) = large;
  if (solver::is_axially_overconstrained(model))
    carried_by(scope, solver::Effect::axial_flexibility) = large;
  return scope;
}

bool is_loaded(const solver::Model& model) {
  const bool on_members = std::any_of(model.members.begin(), model.members.end(),
                                      [](const solver::Member& m) { return !m.load.isZero(0); });
  return on_members || !model.loads.empty() || !model.edge_loads.empty();
}

solver::EffectScope modes_scope(const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model).with(solver::Effect::inertia);
  scope.required = solver::Effects().with(solver::Effect::inertia);
  if (is_loaded(model) || scope.applicable.has(solver::Effect::gravity)) {
    scope.applicable = scope.applicable.with(solver::Effect::geometric_stiffening);
  }
  carried_by(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  carried_by(scope, solver::Effect::geometric_stiffening) =
      solver::Effects().with(solver::Effect::gravity);
  return scope;
}

/// Whatever the frame holds as it turns stays.
solver::EffectScope rotating_scope(const Document& document, const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model)
                         .with(solver::Effect::inertia)
                         .with(solver::Effect::geometric_stiffening);
  scope.required = solver::Effects().with(solver::Effect::inertia);
  if (scope.applicable.has(solver::Effect::gravity))
    scope.required = scope.required.with(solver::Effect::gravity);
  const JsonView rotating = JsonView(document)["analysis"]["modes"]["rotating"];
  // Coriolis forces point out of the plane where the axis lies in it.
  if (rotating.get<std::string>("axis", "normal") == "normal") {
    scope.applicable = scope.applicable.with(solver::Effect::gyroscopic);
  }
  carried_by(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  return scope;
}

solver::EffectScope motion_scope(const Document& document, const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model)
                         .with(solver::Effect::inertia)
                         .with(solver::Effect::gyroscopic);
  const solver::RayleighDamping damping =
      read_rayleigh(JsonView(document)["analysis"]["elastodynamics"].find("damping"));
  const solver::Effects with_velocity =
      solver::Effects().with(solver::Effect::damping).with(solver::Effect::gyroscopic);
  if (damping.mass != 0 || damping.stiffness != 0) {
    scope.applicable = scope.applicable.with(solver::Effect::damping);
  }
  // Inextensible links turn, and constraints that turn with them cost more than stretch does.
  if (scope.applicable.has(solver::Effect::axial_flexibility)) {
    scope.required = solver::Effects().with(solver::Effect::axial_flexibility);
  }
  carried_by(scope, solver::Effect::inertia) = with_velocity;
  carried_by(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  return scope;
}

/// Without "effects": the parts' own words, and the analysis's.
solver::Effects stated_effects(const Document& document, const solver::EffectScope& scope) {
  solver::Effects stated = scope.applicable.without(solver::Effect::large_displacement);
  for (const EffectKey& effect_key : effect_keys(document)) {
    const auto specified = find_key(document, effect_key);
    if (specified ? specified->get<bool>() : effect_key.otherwise) continue;
    stated = scope.without(stated, effect_key.effect);
  }
  return stated;
}

/// Why a scene does not have an effect.
std::string describe_missing(solver::Effect effect, const std::string& kind) {
  switch (effect) {
    case solver::Effect::axial_flexibility:
      return "no member both bends and stretches ('axial')";
    case solver::Effect::shear:
      return "the members do not shear ('beam')";
    case solver::Effect::rotary_inertia:
      return kind == "statics" ? "nothing moves in statics"
                               : "the sections have no rotary inertia ('beam')";
    case solver::Effect::platform_flexibility:
      return "there is no platform of triangles ('kind')";
    case solver::Effect::joint_compliance:
      return "no joint has a spring";
    case solver::Effect::link_mass:
      return kind == "statics" ? "no member has a weight" : "no member has a mass";
    case solver::Effect::gravity:
      return "nothing has a weight ('gravity_m_s2')";
    case solver::Effect::inertia:
    case solver::Effect::gyroscopic:
      return kind == "statics" ? "nothing moves in statics" : "the frame does not turn";
    case solver::Effect::damping:
      return kind == "statics" ? "nothing moves in statics"
             : kind == "modes" ? "modes are those of the undamped model"
                               : "there is no 'damping'";
    case solver::Effect::geometric_stiffening:
      return kind == "modes" ? "there are no loads" : "it belongs to the analysis 'large-motion'";
    case solver::Effect::large_displacement:
      return kind == "modes" ? "modes are small motions"
                             : "it belongs to the analysis 'large-motion'";
  }
  return "";
}

std::string percent(double share) {
  return rounded(100 * share, 3) + " %";
}

/// Why an effect stays, whatever it is worth.
const char* describe_required(solver::Effect effect, const std::string& kind) {
  return kind == "elastodynamics" && effect == solver::Effect::axial_flexibility
             ? "kept, for constraints that turn with the links cost more than it does"
             : "the analysis is of it";
}

std::vector<EffectReason> reasons_without_estimates(const solver::EffectScope& scope,
                                                    solver::Effects chosen, const std::string& kind,
                                                    const std::string& effect_key) {
  std::vector<EffectReason> reasons;
  for (const solver::Effect effect : solver::Effects::all().list()) {
    EffectReason one;
    one.effect = effect;
    one.applicable = scope.applicable.has(effect);
    one.active = one.applicable && chosen.has(effect);
    one.why = !one.applicable              ? describe_missing(effect, kind)
              : scope.required.has(effect) ? describe_required(effect, kind)
              : one.active                 ? effect_key
                                           : "not " + effect_key;
    reasons.push_back(std::move(one));
  }
  return reasons;
}

/// Names, which the schema has checked.
solver::Effects read_names(const JsonView& names, const solver::EffectScope& scope,
                           const std::string& kind) {
  solver::Effects chosen = scope.required;
  for (const auto& [number, place] : names.entries()) {
    const auto effect = solver::effect_named(place.get<std::string>());
    if (!scope.applicable.has(*effect)) {
      throw place.error("expected an effect that the scene admits (got '" +
                        std::string(solver::name_of(*effect)) +
                        "': " + describe_missing(*effect, kind) + ")");
    }
    chosen = chosen.with(*effect);
  }
  for (const solver::Effect effect : chosen.list()) {
    for (const solver::Effect carrier : scope.applicable.list()) {
      const bool carried = scope.dependents[static_cast<std::size_t>(carrier)].has(effect);
      if (carried && !chosen.has(carrier)) {
        throw names.error("expected '" + std::string(solver::name_of(carrier)) + "' beside '" +
                          std::string(solver::name_of(effect)) + "', which is nothing without it");
      }
    }
  }
  return chosen;
}

/// The whole model at a few of its poses, on a mesh that is good enough to decide by.
std::vector<solver::Model> sample_poses(const CaseModel& case_model) {
  constexpr std::size_t kPoses = 4;
  constexpr solver::Index kElements = 8;
  const std::size_t count = std::min(kPoses, case_model.steps());
  std::vector<solver::Model> models;
  for (std::size_t i = 0; i < count; ++i) {
    models.push_back(build_model(case_model, i * case_model.steps() / count));
    for (solver::Member& member : models.back().members) {
      member.elements = std::min(member.elements, kElements);
    }
  }
  return models;
}

std::string describe_decision(const solver::EffectEstimate& estimate, bool active, double tolerance,
                              const solver::EffectScope& scope, solver::Effects chosen) {
  const std::string alone = percent(estimate.size());
  if (!active) {
    return "without it the results change by " + alone + ", within " + percent(tolerance) +
           (estimate.size() > 0 ? " together with all that is off" : "");
  }
  for (const solver::Effect carried :
       scope.dependents[static_cast<std::size_t>(estimate.effect)].list()) {
    if (chosen.has(carried) && estimate.size() < tolerance) {
      return std::string(solver::name_of(carried)) + " needs it";
    }
  }
  if (estimate.size() > tolerance) {
    return "without it the results change by " + alone + ", more than " + percent(tolerance);
  }
  return "without it the results change by " + alone + ", with all that is off by more than " +
         percent(tolerance) + " less a tenth in hand";
}

solver::EffectEstimates estimate(const Document& document, const CaseModel& case_model,
                                 const solver::EffectScope& scope) {
  const std::string kind = analysis_kind(document);
  const JsonView analysis = JsonView(document)["analysis"][kind];
  if (kind == "elastodynamics") {
    return solver::estimate_motion_effects(read_elastodynamics(analysis, case_model),
                                           scope.applicable);
  }
  const std::vector<solver::Model> poses = sample_poses(case_model);
  if (kind == "statics") return solver::estimate_static_effects(poses, scope.applicable);
  if (is_rotating(document)) {
    return solver::estimate_rotating_effects(
        poses.front(), scope.applicable, read_rotating_options(analysis), read_speeds(analysis));
  }
  return solver::estimate_modal_effects(poses, scope.applicable,
                                        analysis["count"].get<solver::Index>());
}

EffectChoice choose_automatically(const Document& document, const CaseModel& case_model,
                                  const solver::EffectScope& scope, double tolerance) {
  const std::string kind = analysis_kind(document);
  const solver::EffectEstimates estimates = estimate(document, case_model, scope);
  EffectChoice choice;
  choice.tolerance = tolerance;
  choice.counters = estimates.counters;
  choice.chosen = choose_effects(estimates, scope, tolerance);
  choice.reasons = reasons_without_estimates(
      scope, choice.chosen, kind,
      "decided: there is no linear solution to decide by (" + estimates.outcome.reason + ")");
  if (!estimates.outcome.solved()) return choice;
  for (const solver::EffectEstimate& estimate : estimates.effects) {
    EffectReason& one = choice.reasons[static_cast<std::size_t>(estimate.effect)];
    if (scope.required.has(estimate.effect)) continue;
    one.number = estimate.number;
    one.change = estimate.size();
    one.why = describe_decision(estimate, one.active, tolerance, scope, choice.chosen);
  }
  return choice;
}

}  // namespace

bool knows_effects(const Document& document) {
  const std::string kind = analysis_kind(document);
  return kind == "statics" || kind == "modes" || kind == "elastodynamics";
}

solver::EffectScope effect_scope(const Document& document, const CaseModel& case_model) {
  const solver::Model model = build_model(case_model, 0);
  const std::string kind = analysis_kind(document);
  solver::EffectScope scope = kind == "statics"          ? statics_scope(model)
                              : kind == "elastodynamics" ? motion_scope(document, model)
                              : is_rotating(document)    ? rotating_scope(document, model)
                                                         : modes_scope(model);
  if (!model.triangles.empty()) {
    scope.applicable = scope.applicable.with(solver::Effect::platform_flexibility);
    // Plates that are no platform are what there is.
    if (!case_model.manipulator)
      scope.required = scope.required.with(solver::Effect::platform_flexibility);
  }
  return scope;
}

EffectChoice choose_effects(const Document& document, const CaseModel& case_model) {
  const auto requested = JsonView(document).find("effects");
  if (!knows_effects(document)) {
    if (requested)
      throw requested->error(std::string("expected an analysis that knows effects: ") +
                             kAnalysesWithEffects);
    return {};
  }
  const std::string kind = analysis_kind(document);
  const solver::EffectScope scope = effect_scope(document, case_model);
  EffectChoice choice;
  if (!requested) {
    choice.chosen = stated_effects(document, scope);
    choice.reasons = reasons_without_estimates(scope, choice.chosen, kind, "stated by the parts");
    return choice;
  }
  for (const EffectKey& effect_key : effect_keys(document)) {
    const auto specified = find_key(document, effect_key);
    if (!specified) continue;
    throw specified->error("expected 'effects' alone to say it: " +
                           std::string(solver::name_of(effect_key.effect)));
  }
  if (requested->json().is_object()) {
    return choose_automatically(document, case_model, scope,
                                (*requested)["auto"].number("tolerance"));
  }
  choice.chosen = read_names(*requested, scope, kind);
  choice.reasons = reasons_without_estimates(scope, choice.chosen, kind, "asked for");
  return choice;
}

std::string describe_effect_number(solver::Effect effect, const std::string& analysis) {
  const bool statics = analysis == "statics", motion = analysis == "elastodynamics";
  switch (effect) {
    case solver::Effect::axial_flexibility:
      return statics ? "(r / L)^2, the squared slenderness" : "share of the strain energy";
    case solver::Effect::shear:
      return statics ? "12 E I / (kappa G A L^2)" : "share of the strain energy";
    case solver::Effect::platform_flexibility:
    case solver::Effect::joint_compliance:
      return "share of the strain energy";
    case solver::Effect::rotary_inertia:
      return "share of the kinetic energy";
    case solver::Effect::link_mass:
      return statics ? "weight of members over all loads, in energy"
                     : "share of the kinetic energy";
    case solver::Effect::gravity:
      return statics  ? "other weights over all loads, in energy"
             : motion ? "weights over all loads, in energy"
                      : "share of the stiffness";
    case solver::Effect::geometric_stiffening:
      return statics ? "load over buckling load, tension positive" : "share of the stiffness";
    case solver::Effect::large_displacement:
      return "largest rotation [rad]";
    case solver::Effect::inertia:
      return motion ? "(speed of the path over the first frequency)^2" : "";
    case solver::Effect::damping:
      return "damping ratio of the first mode";
    case solver::Effect::gyroscopic:
      return motion ? "twice the fastest turning over the first frequency"
                    : "share of the stiffness";
  }
  return "";
}

Document with_effects(const Document& document, solver::Effects effects) {
  Document changed = document;
  Json names = Json::array();
  for (const solver::Effect effect : effects.list())
    names.push_back(std::string(solver::name_of(effect)));
  Json patch = {{"effects", names}};
  for (const EffectKey& effect_key : effect_keys(document)) {
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
