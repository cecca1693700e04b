#include "harness/analysis/effect_rules.h"

#include <algorithm>
#include <array>

#include "harness/motion/analyse_elastodynamics.h"
#include "harness/readers/time_reader.h"
#include "harness/statics_modes/rotating_state.h"
#include "solver/assembly/restrict_model_effects.h"
#include "solver/effects/axial_constraints.h"
#include "solver/effects/dynamic_effect_estimates.h"
#include "solver/effects/modal_effect_estimates.h"
#include "solver/effects/rotating_effect_estimates.h"
#include "solver/effects/static_effect_estimates.h"

namespace trammel::harness {
namespace {

/// Of one effect, by analysis: statics, modes, elastodynamics.
struct EffectWords {
  std::array<const char*, 3> number, missing;
};

constexpr const char* kStrain = "share of the strain energy";
constexpr const char* kKinetic = "share of the kinetic energy";
constexpr const char* kStiffness = "share of the stiffness";
constexpr const char* kAtRest = "nothing moves in statics";
constexpr const char* kLarge = "it belongs to the analysis 'large-motion'";

constexpr std::array<const char*, 3> all(const char* text) {
  return {text, text, text};
}

const EffectWords& words_of(solver::Effect effect) {
  static const std::array<EffectWords, solver::kEffectCount> table = {{
      /* axial flexibility */
      {{"(r / L)^2, the squared slenderness", kStrain, kStrain},
       all("no member both bends and stretches ('axial')")},
      /* shear */
      {{"12 E I / (kappa G A L^2)", kStrain, kStrain}, all("the members do not shear ('beam')")},
      /* rotary inertia */
      {all(kKinetic),
       {kAtRest, "the sections have no rotary inertia ('beam')",
        "the sections have no rotary inertia ('beam')"}},
      /* platform flexibility */
      {all(kStrain), all("there is no platform of triangles ('kind')")},
      /* joint compliance */
      {all(kStrain), all("no joint has a spring")},
      /* link mass */
      {{"weight of members over all loads, in energy", kKinetic, kKinetic},
       {"no member has a weight", "no member has a mass", "no member has a mass"}},
      /* gravity */
      {{"other weights over all loads, in energy", kStiffness, "weights over all loads, in energy"},
       all("nothing has a weight ('gravity_m_s2')")},
      /* inertia */
      {{"", "", "(speed of the path over the first frequency)^2"},
       {kAtRest, "the frame does not turn", "the frame does not turn"}},
      /* damping */
      {all("damping ratio of the first mode"),
       {kAtRest, "modes are those of the undamped model", "there is no 'damping'"}},
      /* gyroscopic */
      {{kStiffness, kStiffness, "twice the fastest turning over the first frequency"},
       {kAtRest, "the frame does not turn", "the frame does not turn"}},
      /* geometric stiffening */
      {{"geometric over elastic strain energy, tension positive", kStiffness, kStiffness},
       {kLarge, "there are no loads", kLarge}},
      /* large displacement */
      {all("largest rotation [rad]"), {kLarge, "modes are small motions", kLarge}},
  }};
  return table[static_cast<std::size_t>(effect)];
}

solver::EffectScope statics_scope(const JsonView&, const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model).without(solver::Effect::rotary_inertia);
  if (!scope.applicable.has(solver::Effect::gravity)) {
    scope.applicable = scope.applicable.without(solver::Effect::link_mass);
  }
  scope.applicable = scope.applicable.with(solver::Effect::geometric_stiffening)
                         .with(solver::Effect::large_displacement);
  dependents_of(scope, solver::Effect::gravity) = solver::Effects().with(solver::Effect::link_mass);
  const solver::Effects large = solver::Effects().with(solver::Effect::large_displacement);
  dependents_of(scope, solver::Effect::geometric_stiffening) = large;
  if (solver::is_axially_overconstrained(model))
    dependents_of(scope, solver::Effect::axial_flexibility) = large;
  return scope;
}

bool is_loaded(const solver::Model& model) {
  const bool on_members = std::any_of(model.members.begin(), model.members.end(),
                                      [](const solver::Member& m) { return !m.load.isZero(0); });
  return on_members || !model.loads.empty() || !model.edge_loads.empty();
}

solver::EffectScope modes_at_rest_scope(const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model).with(solver::Effect::inertia);
  scope.required = solver::Effects().with(solver::Effect::inertia);
  if (is_loaded(model) || scope.applicable.has(solver::Effect::gravity)) {
    scope.applicable = scope.applicable.with(solver::Effect::geometric_stiffening);
  }
  dependents_of(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  dependents_of(scope, solver::Effect::geometric_stiffening) =
      solver::Effects().with(solver::Effect::gravity);
  return scope;
}

/// Whatever the frame holds as it turns stays.
solver::EffectScope rotating_scope(const JsonView& rotating, const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model)
                         .with(solver::Effect::inertia)
                         .with(solver::Effect::geometric_stiffening);
  scope.required = solver::Effects().with(solver::Effect::inertia);
  if (scope.applicable.has(solver::Effect::gravity))
    scope.required = scope.required.with(solver::Effect::gravity);
  // Coriolis forces point out of the plane where the axis lies in it.
  if (rotating.get<std::string>("axis", "normal") == "normal") {
    scope.applicable = scope.applicable.with(solver::Effect::gyroscopic);
  }
  dependents_of(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  return scope;
}

solver::EffectScope motion_scope(const JsonView& analysis, const solver::Model& model) {
  solver::EffectScope scope;
  scope.applicable = solver::applicable_effects(model)
                         .with(solver::Effect::inertia)
                         .with(solver::Effect::gyroscopic);
  const solver::RayleighDamping damping = read_rayleigh(analysis.find("damping"));
  const solver::Effects with_velocity =
      solver::Effects().with(solver::Effect::damping).with(solver::Effect::gyroscopic);
  if (damping.mass != 0 || damping.stiffness != 0) {
    scope.applicable = scope.applicable.with(solver::Effect::damping);
  }
  // Inextensible links turn, and constraints that turn with them cost more than stretch does.
  if (scope.applicable.has(solver::Effect::axial_flexibility)) {
    scope.required = solver::Effects().with(solver::Effect::axial_flexibility);
  }
  dependents_of(scope, solver::Effect::inertia) = with_velocity;
  dependents_of(scope, solver::Effect::link_mass) =
      solver::Effects().with(solver::Effect::rotary_inertia);
  return scope;
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

std::vector<EffectKey> modes_keys(const JsonView& analysis) {
  if (analysis.has("rotating")) {
    return {{solver::Effect::gyroscopic, {"rotating", "coriolis"}, true}};
  }
  return {{solver::Effect::geometric_stiffening, {"prestressed"}, false}};
}

solver::EffectScope modes_scope(const JsonView& analysis, const solver::Model& model) {
  return analysis.has("rotating") ? rotating_scope(analysis["rotating"], model)
                                  : modes_at_rest_scope(model);
}

solver::EffectEstimates estimate_for_modes(const JsonView& analysis, const CaseModel& case_model,
                                           const solver::EffectScope& scope) {
  const std::vector<solver::Model> poses = sample_poses(case_model);
  if (analysis.has("rotating")) {
    return solver::estimate_rotating_effects(
        poses.front(), scope.applicable, read_rotating_options(analysis), read_speeds(analysis));
  }
  return solver::estimate_modal_effects(poses, scope.applicable,
                                        analysis["count"].get<solver::Index>());
}

}  // namespace

const char* EffectRules::describe_missing(solver::Effect effect) const {
  return words_of(effect).missing[column];
}

const char* EffectRules::describe_number(solver::Effect effect) const {
  return words_of(effect).number[column];
}

const char* EffectRules::describe_required(solver::Effect effect) const {
  return effect == solver::Effect::axial_flexibility
             ? "kept, for constraints that turn with the links cost more than it does"
             : "the analysis is of it";
}

solver::Effects& dependents_of(solver::EffectScope& scope, solver::Effect effect) {
  return scope.dependents[static_cast<std::size_t>(effect)];
}

const EffectRules& statics_effects() {
  static const EffectRules rules = {
      [](const JsonView&) -> std::vector<EffectKey> {
        return {{solver::Effect::geometric_stiffening, {"second_order"}, false}};
      },
      statics_scope,
      [](const JsonView&, const CaseModel& case_model, const solver::EffectScope& scope) {
        return solver::estimate_static_effects(sample_poses(case_model), scope.applicable);
      },
      0};
  return rules;
}

const EffectRules& modes_effects() {
  static const EffectRules rules = {modes_keys, modes_scope, estimate_for_modes, 1};
  return rules;
}

const EffectRules& elastodynamics_effects() {
  static const EffectRules rules = {
      [](const JsonView&) -> std::vector<EffectKey> {
        return {{solver::Effect::inertia, {"effects", "elastic_inertia"}, true},
                {solver::Effect::gyroscopic, {"effects", "transformation_rate_terms"}, false}};
      },
      motion_scope,
      [](const JsonView& analysis, const CaseModel& case_model, const solver::EffectScope& scope) {
        return solver::estimate_motion_effects(read_elastodynamics(analysis, case_model),
                                               scope.applicable);
      },
      2};
  return rules;
}

}  // namespace trammel::harness
