#include "harness/analysis/effect_rules.h"

#include <algorithm>
#include <array>

#include "harness/motion/analyses.h"
#include "harness/readers/option_reader.h"
#include "solver/large/large_elastodynamics.h"
#include "solver/linear/validate.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

/// Formula of an effect's dimensionless number, and the reasons why the effect is not applicable to
/// statics, modes, elastodynamics and other motions.
struct EffectWords {
  const char* number;
  std::array<const char*, 4> missing;
};

constexpr const char* kAtRest = "statics has no motion";
constexpr const char* kNoRotary = "the beam theory of the sections has no rotary inertia";
constexpr const char* kNoMass = "no member has a mass";
constexpr const char* kNotTurning = "the frame does not rotate";
constexpr const char* kNotTurningInPlane = "no frame rotates about an axis normal to the plane";
constexpr const char* kNoDamping = "the analysis has no key 'damping'";
constexpr const char* kLarge = "vibration with this effect requires 'large-motion'";

constexpr std::array<const char*, 4> all(const char* text) {
  return {text, text, text, text};
}

const EffectWords& words_of_effect(Effect effect) {
  static const std::array<EffectWords, solver::kEffectCount> table = {{
      /* axial flexibility */
      {"(k r)^2, k = n pi / L", all("no member has both bending and axial flexibility ('axial')")},
      /* shear */
      {"E I k^2 / (kappa G A), k = n pi / L", all("members have no shear strain ('beam')")},
      /* rotary inertia */
      {"(k r)^2, k = n pi / L", {kAtRest, kNoRotary, kNoRotary, kNoRotary}},
      /* platform flexibility */
      {"(E I / L^3) / (E t of the platform)", all("there is no platform of triangles ('kind')")},
      /* joint compliance */
      {"E I k / spring, k = n pi / L", all("no joint has a spring")},
      /* link mass */
      {"", {"no member has a weight", kNoMass, kNoMass, kNoMass}},
      /* gravity */
      {"", all("no part has a weight ('gravity_m_s2')")},
      /* inertia */
      {"(angular speed of the path / first natural angular frequency)^2",
       {kAtRest, kNotTurning, kNotTurning, kNotTurning}},
      /* damping */
      {"damping ratio of the first mode",
       {kAtRest, "modes are computed without damping", kNoDamping, kNoDamping}},
      /* gyroscopic */
      {"", {kAtRest, kNotTurningInPlane, kNotTurningInPlane, "included in 'rotating_frame'"}},
      /* geometric stiffening */
      {"ratio of the loads to the buckling load of a hinged member",
       {kLarge, "there are no loads", "'large-displacement' includes this effect", kLarge}},
      /* large displacement */
      {"", {kLarge, "modes describe small motions only", "", kLarge}},
  }};
  return table[static_cast<std::size_t>(effect)];
}

EffectScope effects_in_statics(const JsonView&, const solver::Model& model) {
  EffectScope scope;
  scope.applicable = solver::applicable_effects(model).without(Effect::rotary_inertia);
  if (!scope.applicable.has(Effect::gravity))
    scope.applicable = scope.applicable.without(Effect::link_mass);
  scope.applicable =
      scope.applicable.with(Effect::geometric_stiffening).with(Effect::large_displacement);
  dependent_effects(scope, Effect::gravity) = Effects().with(Effect::link_mass);
  const Effects large = Effects().with(Effect::large_displacement);
  dependent_effects(scope, Effect::geometric_stiffening) = large;
  if (solver::is_axially_overconstrained(model))
    dependent_effects(scope, Effect::axial_flexibility) = large;
  return scope;
}

bool has_any_load(const solver::Model& model) {
  const bool on_members =
      std::ranges::any_of(model.members, [](const solver::Member& m) { return !m.load.isZero(0); });
  return on_members || !model.loads.empty() || !model.edge_loads.empty();
}

/// Returns the applicable and the required effects of an analysis of vibration.
EffectScope effects_with_inertia(const solver::Model& model) {
  EffectScope scope;
  scope.applicable = solver::applicable_effects(model).with(Effect::inertia);
  scope.required = Effects().with(Effect::inertia);
  dependent_effects(scope, Effect::link_mass) = Effects().with(Effect::rotary_inertia);
  return scope;
}

EffectScope effects_in_rest_modes(const solver::Model& model) {
  EffectScope scope = effects_with_inertia(model);
  if (has_any_load(model) || scope.applicable.has(Effect::gravity))
    scope.applicable = scope.applicable.with(Effect::geometric_stiffening);
  dependent_effects(scope, Effect::geometric_stiffening) = Effects().with(Effect::gravity);
  return scope;
}

/// Returns the applicable and the required effects of modes in a rotating frame. If the model has
/// gravity, gravity is a required effect.
EffectScope effects_in_rotating_modes(const JsonView& rotating, const solver::Model& model) {
  EffectScope scope = effects_with_inertia(model);
  scope.applicable = scope.applicable.with(Effect::geometric_stiffening);
  if (scope.applicable.has(Effect::gravity)) scope.required = scope.required.with(Effect::gravity);
  // If the axis of rotation lies in the plane of the model, Coriolis forces are normal to this
  // plane.
  if (rotating.get<std::string>("axis", "normal") == "normal")
    scope.applicable = scope.applicable.with(Effect::gyroscopic);
  return scope;
}

EffectScope effects_in_given_motion(const JsonView& analysis, const solver::Model& model) {
  EffectScope scope;
  scope.applicable =
      solver::applicable_effects(model).with(Effect::inertia).with(Effect::gyroscopic);
  const solver::RayleighDamping damping = read_rayleigh(analysis.find("damping"));
  const Effects with_velocity = Effects().with(Effect::damping).with(Effect::gyroscopic);
  if (damping.mass != 0 || damping.stiffness != 0)
    scope.applicable = scope.applicable.with(Effect::damping);
  // Axial flexibility is required, because the constraints of rotating inextensible links would
  // increase the computing time.
  if (scope.applicable.has(Effect::axial_flexibility))
    scope.required = Effects().with(Effect::axial_flexibility);
  scope.no_large_displacement =
      solver::reason_no_large_displacement(read_model_independent_options(analysis), model);
  if (scope.no_large_displacement == nullptr)
    scope.applicable = scope.applicable.with(Effect::large_displacement);
  dependent_effects(scope, Effect::inertia) = with_velocity;
  dependent_effects(scope, Effect::link_mass) = Effects().with(Effect::rotary_inertia);
  return scope;
}

/// Returns true if point masses or plates have mass. If they have no mass, vibration requires the
/// mass of members.
bool has_mass_besides_members(const solver::Model& model) {
  return std::ranges::any_of(model.masses,
                             [](const solver::PointMass& one) { return one.mass > 0; }) ||
         std::ranges::any_of(model.plates,
                             [](const solver::Plate& one) { return one.material.rho > 0; });
}

EffectScope effects_in_vibration(const JsonView& analysis, const solver::Model& model) {
  EffectScope scope = effects_with_inertia(model);
  if (scope.applicable.has(Effect::link_mass) && !has_mass_besides_members(model))
    scope.required = scope.required.with(Effect::link_mass);
  if (analysis.has("damping")) scope.applicable = scope.applicable.with(Effect::damping);
  return scope;
}

/// Returns the applicable and the required effects of a harmonic analysis. Damping is required,
/// because only damping bounds a resonance peak, whose height the sampled frequencies do not show.
EffectScope effects_in_harmonic(const JsonView& analysis, const solver::Model& model) {
  EffectScope scope = effects_in_vibration(analysis, model);
  if (scope.applicable.has(Effect::damping)) scope.required = scope.required.with(Effect::damping);
  return scope;
}

EffectScope effects_in_large_motion(const JsonView& analysis, const solver::Model& model) {
  EffectScope scope = effects_in_vibration(analysis, model);
  if (analysis.has("mass_damping_per_s") || analysis.has("strain_rate_damping_s"))
    scope.applicable = scope.applicable.with(Effect::damping);
  for (const Effect effect : {Effect::geometric_stiffening, Effect::large_displacement}) {
    scope.applicable = scope.applicable.with(effect);
    scope.required = scope.required.with(effect);
  }
  return scope;
}

std::vector<EffectKey> no_keys(const JsonView&) {
  return {};
}

std::vector<EffectKey> effect_keys_of_modes(const JsonView& analysis) {
  if (analysis.has("rotating")) return {{Effect::gyroscopic, {"rotating", "coriolis"}, true}};
  return {{Effect::geometric_stiffening, {"prestressed"}, false}};
}

EffectScope effects_in_modes(const JsonView& analysis, const solver::Model& model) {
  return analysis.has("rotating") ? effects_in_rotating_modes(analysis["rotating"], model)
                                  : effects_in_rest_modes(model);
}

}  // namespace

Effects EffectScope::with_implied_effects(Effects set) const {
  const bool contains = applicable.has(Effect::gyroscopic) && set.has(Effect::large_displacement) &&
                        set.has(Effect::inertia);
  return contains ? set.with(Effect::gyroscopic) : set;
}

Effects EffectScope::remove_with_dependents(Effects set, Effect effect) const {
  set = set.without(effect);
  for (const Effect dependent : dependents[static_cast<std::size_t>(effect)].list())
    if (set.has(dependent)) set = remove_with_dependents(set, dependent);
  return set;
}

const char* EffectRules::reason_not_applicable(Effect effect) const {
  return words_of_effect(effect).missing[column];
}

const char* dimensionless_number_formula(Effect effect) {
  return words_of_effect(effect).number;
}

const char* reason_why_effect_is_required(Effect effect) {
  if (effect == Effect::damping) return "required: only damping limits a resonance";
  return effect == Effect::axial_flexibility
             ? "required: inextensible links would increase the computing time"
             : "required by this analysis";
}

Effects& dependent_effects(EffectScope& scope, Effect effect) {
  return scope.dependents[static_cast<std::size_t>(effect)];
}

const EffectRules kStaticsEffects = {
    [](const JsonView&) -> std::vector<EffectKey> {
      return {{Effect::geometric_stiffening, {"second_order"}, false}};
    },
    effects_in_statics, 0};

const EffectRules kModesEffects = {effect_keys_of_modes, effects_in_modes, 1};

const EffectRules kElastodynamicsEffects = {
    [](const JsonView&) -> std::vector<EffectKey> {
      return {{Effect::inertia, {"effects", "elastic_inertia"}, true},
              {Effect::gyroscopic, {"effects", "transformation_rate_terms"}, false}};
    },
    effects_in_given_motion, 2};

const EffectRules kHarmonicEffects = {no_keys, effects_in_harmonic, 3};
const EffectRules kTransientEffects = {no_keys, effects_in_vibration, 3};
const EffectRules kLargeMotionEffects = {no_keys, effects_in_large_motion, 3};

solver::Model model_at_path_start(const CaseModel& case_model) {
  const bool only_large = !case_model.joint_elements.line_springs.empty() ||
                          !case_model.joint_elements.follower_loads.empty();
  return only_large ? build_without_joint_elements(case_model, 0) : build_model(case_model, 0);
}

}  // namespace trammel::harness
