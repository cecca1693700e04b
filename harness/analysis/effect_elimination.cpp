#include "harness/analysis/effect_elimination.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "harness/analysis/effect_changes.h"
#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"
#include "harness/motion/analyse_elastodynamics.h"
#include "harness/scene/observables.h"
#include "solver/large/large_elastodynamics.h"
#include "solver/model/model.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A coarse mesh measures a change to within about a fifth, a platform of three triangles to within
/// a factor of three, and large displacement not much better: what it finds between these shares of
/// the tolerance is measured on the scene's own mesh.
constexpr double kSurelyWithin = 0.75, kPlatformSurelyWithin = 0.25;
constexpr double kSurelyBeyond = 1.25;
/// The same of what linear theory finds for a scene of large displacement, by which nothing stays
/// on, for the forces that matter may be others there; and of leaving large displacement out, for
/// the two theories err otherwise on a coarse mesh, and near buckling both by much.
constexpr double kOtherTheorySurelyBeyond = 20;
/// Linear theory off by more is off by more than the amplification up to a buckling load: beyond
/// it, where second-order theory searches long for what it does not have.
constexpr double kLost = 1;

class EliminationOf {
 public:
  EliminationOf(const EffectScope& scope, double tolerance, const ChangeWith& change_with)
      : scope_(scope), tolerance_(tolerance), change_with_(change_with) {
    found_.chosen = scope.applicable;
    decided_ = scope.required;
  }

  Elimination run(const std::vector<Effect>& order, Effects negligible) {
    if (!negligible.empty()) try_without(negligible.list());
    for (const Effect effect : order) decide(effect);
    return found_;
  }

 private:
  bool try_without(const std::vector<Effect>& effects) {
    Effects left = found_.chosen;
    for (const Effect effect : effects) left = scope_.without(left, effect);
    const double change = change_with_(left);
    const bool within = change <= tolerance_;
    if (within) found_.chosen = left;
    for (const Effect effect : effects) {
      if (within) decided_ = decided_.with(effect);
      if (within || effects.size() == 1) found_.change[static_cast<std::size_t>(effect)] = change;
    }
    return within;
  }

  void decide(Effect effect) {
    if (decided_.has(effect) || !scope_.applicable.has(effect)) return;
    decided_ = decided_.with(effect);
    for (const Effect dependent : scope_.dependents[static_cast<std::size_t>(effect)].list())
      decide(dependent);
    const bool carries = !(scope_.without(found_.chosen, effect) == found_.chosen.without(effect));
    if (!carries) try_without({effect});
  }

  const EffectScope& scope_;
  double tolerance_;
  const ChangeWith& change_with_;
  Elimination found_;
  Effects decided_;
};

/// The scene on one mesh: its results with some effects at some step, each computed once.
class MeshedScene {
 public:
  MeshedScene(const AnalysisKind& kind, const JsonView& analysis, CaseModel scene, Effects all,
              const ModelScales& size)
      : kind_(kind), analysis_(analysis), scene_(std::move(scene)), all_(all), size_(size) {}

  /// Nothing where there is no solution.
  const std::optional<Quantities>& at(Effects effects, std::size_t step) {
    compute_missing(effects, {step});
    return of(effects).at(step);
  }

  double change(Effects whole, Effects effects, const std::set<std::size_t>& steps) {
    const auto full = along(whole, steps), other = along(effects, steps);
    if (!full || !other) return kInfinite;
    const Changes changes = changes_between(*full, *other, size_);
    return changes.empty() ? kInfinite : max_change(changes).value;
  }

  /// One after the other; nothing where one is missing.
  std::optional<Quantities> along(Effects effects, const std::set<std::size_t>& steps) {
    compute_missing(effects, steps);
    Quantities all;
    for (const std::size_t step : steps) {
      const auto& found = of(effects).at(step);
      if (!found) return std::nullopt;
      for (const auto& [name, quantity] : *found) {
        auto& values = all[name].values;
        values.insert(values.end(), quantity.values.begin(), quantity.values.end());
      }
    }
    return all;
  }

  solver::Outcome outcome;  ///< of the whole scene
  solver::Counters counters;

 private:
  using ByStep = std::map<std::size_t, std::optional<Quantities>>;

  ByStep& of(Effects effects) {
    const auto is_its = [&](const auto& run) { return run.first == effects; };
    return find_or_add(runs_, is_its, {effects, {}}).second;
  }

  void compute_missing(Effects effects, const std::set<std::size_t>& steps) {
    ByStep& run = of(effects);
    std::vector<std::size_t> missing;
    for (const std::size_t step : steps)
      if (run.count(step) == 0) missing.push_back(step);
    if (missing.empty()) return;
    if (kind_.of_points.at == nullptr) {
      for (const std::size_t step : missing) run[step] = compute(effects, {step});
      return;
    }
    const auto all = compute(effects, missing);
    for (std::size_t i = 0; i < missing.size(); ++i) {
      auto& one = run[missing[i]];
      if (all) one.emplace();
      for (const auto& [name, quantity] : all ? *all : Quantities())
        (*one)[name].values = {quantity.values[i]};
    }
  }

  std::optional<Quantities> compute(Effects effects, const std::vector<std::size_t>& steps) {
    Recorder record;
    scene_.effects = effects;
    try {
      const StepResult result = run(steps, record);
      counters += result.counters;
      const bool estimated =
          scene_.estimates_large_displacement && effects.has(Effect::large_displacement);
      const solver::Outcome found =
          estimated ? result.outcome
                    : solver::outcome_by_evidence(result.outcome, result.evidence, kind_.evidence);
      if (effects == all_ && outcome.solved())
        outcome = outcome_at_path_point(scene_, steps.front(), found);
      if (!found.solved()) return std::nullopt;
    } catch (const solver::ModelError&) {  // what is left means nothing without the effect
      if (effects == all_) throw;
      return std::nullopt;
    } catch (const InputError&) {  // as fewer modes than damping ratios
      if (effects == all_) throw;
      return std::nullopt;
    }
    return record.take_quantities();
  }

  StepResult run(const std::vector<std::size_t>& steps, Recorder& record) const {
    if (kind_.of_points.at != nullptr) return kind_.of_points.at(analysis_, scene_, steps, record);
    if (const auto* along_path = std::get_if<AnalysePath*>(&kind_.of_scene))
      return (*along_path)(analysis_, scene_, false, record);
    return std::get<AnalyseStep*>(kind_.of_scene)(analysis_, scene_, steps.front(), false, record);
  }

  const AnalysisKind& kind_;
  const JsonView& analysis_;
  CaseModel scene_;
  Effects all_;
  ModelScales size_;
  std::vector<std::pair<Effects, ByStep>> runs_;
};

/// At most so many elements a member; @returns whether there are fewer than before.
bool coarsen_members(CaseModel& scene, solver::Index most) {
  bool coarser = false;
  const auto limit = [&](solver::Index& elements) {
    coarser = coarser || elements > most;
    elements = std::min(elements, most);
  };
  for (solver::Member& member : scene.structure.members) limit(member.elements);
  if (!scene.manipulator) return coarser;
  for (std::size_t i = 0; i < 3; ++i) {
    limit(scene.manipulator->proximal[i].elements);
    limit(scene.manipulator->distal[i].elements);
  }
  return coarser;
}

/// A platform of three triangles; @returns whether it had more.
bool coarsen_platform(CaseModel& scene) {
  if (!scene.manipulator) return false;
  solver::PlatformDesign& platform = scene.manipulator->platform;
  if (platform.pin_radius > 0 || (platform.refinements == 0 && !platform.six_nodes)) return false;
  platform.refinements = 0;
  platform.six_nodes = false;
  return true;
}

bool is_prismatic(const solver::Member& member) {
  const solver::Section &a = member.section, &b = member.end_section;
  return a.EA == b.EA && a.EI == b.EI;
}

/// Those that slenderness alone makes look negligible: measured all at once, they cost one run.
Effects negligible_effects(const solver::Model& model, const EffectScope& scope, double tolerance) {
  Effects negligible;
  for (const Effect effect : {Effect::axial_flexibility, Effect::shear, Effect::rotary_inertia}) {
    const bool carries = !scope.dependents[static_cast<std::size_t>(effect)].empty();
    if (!scope.applicable.has(effect) || scope.required.has(effect) || carries) continue;
    if (*slenderness_number(effect, model) < 0.1 * tolerance) negligible = negligible.with(effect);
  }
  return negligible;
}

class Measurement {
 public:
  Measurement(const AnalysisKind& kind, const JsonView& analysis, const CaseModel& scene,
              const EffectScope& scope, double tolerance)
      : scope_(scope), tolerance_(tolerance) {
    const solver::Model model = first_model(scene);
    size_ = scales_of(model);
    const auto members = std::max<solver::Index>(std::ssize(model.members), 1);
    CaseModel coarse = scene, coarsest = scene;
    const bool vibrates = kind.effects == &kHarmonicEffects || kind.effects == &kTransientEffects ||
                          kind.effects == &kLargeMotionEffects;
    const solver::Index elements =
        vibrates ? 4 : 2 + analysis.get<solver::Index>("count", 0) / members;
    try_linearly_ = !scope.required.has(Effect::large_displacement);
    // Beside a resonance a coarse mesh, which has another frequency, says nothing.
    has_points_ = kind.of_points.at != nullptr;
    const bool has_coarser_platform = !has_points_ && coarsen_platform(coarse);
    is_coarser_ = !has_points_ && (coarsen_members(coarse, elements) || has_coarser_platform);
    coarsen_members(coarsest, 1);
    coarsen_platform(coarsest);
    coarsest.estimates_large_displacement = true;
    is_linear_exact_ = &kind == &find_analysis("statics") && !has_coarser_platform &&
                       std::ranges::all_of(model.members, is_prismatic);
    coarsest_.emplace(kind, analysis, std::move(coarsest), scope.applicable, size_);
    coarse_.emplace(kind, analysis, std::move(coarse), scope.applicable, size_);
    own_.emplace(kind, analysis, scene, scope.applicable, size_);
    const bool one_by_one = std::holds_alternative<AnalyseStep*>(kind.of_scene);
    if (has_points_) every_step_ = kind.of_points.sample(analysis, scene);
    for (std::size_t step = 0; !has_points_ && step < (one_by_one ? scene.steps() : 1); ++step)
      every_step_.insert(step);
    negligible_ = negligible_effects(model, scope, tolerance);
  }

  Elimination run() {
    choose_steps();
    Elimination found;
    do {
      found = eliminate(scope_, kOrder, negligible_, tolerance_,
                        [this](Effects active) { return change_with(active); });
      if (!tried_linearly_ || change_from_whole(found.chosen) <= tolerance_) continue;
      try_linearly_ = tried_linearly_ = false;
      found = eliminate(scope_, kOrder, negligible_, tolerance_,
                        [this](Effects active) { return change_with(active); });
    } while (coarse_->outcome.solved() && add_worst_step(found));
    found.outcome = coarse_->outcome;
    found.counters = coarse_->counters;
    found.counters += own_->counters;
    found.counters += coarsest_->counters;
    return found;
  }

 private:
  /// What costs most first.
  inline static const std::vector<Effect> kOrder = {Effect::large_displacement,
                                                    Effect::geometric_stiffening,
                                                    Effect::gyroscopic,
                                                    Effect::damping,
                                                    Effect::shear,
                                                    Effect::rotary_inertia,
                                                    Effect::axial_flexibility,
                                                    Effect::joint_compliance,
                                                    Effect::platform_flexibility,
                                                    Effect::link_mass,
                                                    Effect::gravity,
                                                    Effect::inertia};

  [[nodiscard]] Effects linear(Effects effects) const {
    return scope_.without(scope_.without(effects, Effect::geometric_stiffening),
                          Effect::large_displacement);
  }

  double change_with(Effects active) {
    const bool is_large = scope_.applicable.has(Effect::large_displacement);
    if (is_large && !active.has(Effect::large_displacement)) {
      // Tension as large as the buckling load halves what linear theory finds.
      if (change_of_linear_theory() > 2 * kLost) return change_of_linear_theory();
    }
    if (try_linearly_ && active.has(Effect::large_displacement)) {
      const double change = change_from(linear(scope_.applicable), linear(active));
      if (change <= tolerance_) tried_linearly_ = true;
      if (change <= tolerance_ || change > kOtherTheorySurelyBeyond * tolerance_) return change;
    }
    return change_from_whole(active);
  }

  double change_of_linear_theory() {
    return coarse_->change(scope_.applicable, linear(scope_.applicable), steps_);
  }

  double change_from_whole(Effects active) { return change_from(scope_.applicable, active); }

  double change_from(Effects full, Effects active) {
    if (linear(full) == full && is_linear_exact_) return coarsest_->change(full, active, steps_);
    const double change = coarse_->change(full, active, steps_);
    if (!is_coarser_) return change;
    const bool stiffens_platform =
        full.has(Effect::platform_flexibility) && !active.has(Effect::platform_flexibility);
    const double within = stiffens_platform ? kPlatformSurelyWithin : kSurelyWithin;
    const bool lost = !std::isfinite(change) && linear(active) == active;
    const bool changes_theory =
        full.has(Effect::large_displacement) && !active.has(Effect::large_displacement);
    const double beyond = changes_theory ? kOtherTheorySurelyBeyond : kSurelyBeyond;
    const bool settled = change <= within * tolerance_ || change > beyond * tolerance_;
    return settled && !lost ? change : change_on_own_mesh(full, active);
  }

  /// Of the whole scene from linear theory on the coarse mesh, and from there on its own, where
  /// these two settle it: the sides of a triangle.
  double change_on_own_mesh(Effects full, Effects active) {
    if (linear(active) == active && !(linear(full) == full)) {
      const double coarse = coarse_->change(full, linear(full), steps_);
      MeshedScene& mesh = is_linear_exact_ ? *coarsest_ : *own_;
      const double own = mesh.change(linear(full), active, steps_);
      if (coarse + own <= tolerance_ || own - coarse > tolerance_) return coarse + own;
    }
    return own_->change(full, active, steps_);
  }

  /// Of every step: one element a member does not vibrate.
  MeshedScene& overview() { return has_points_ ? *coarse_ : *coarsest_; }

  /// Where linear theory has its largest displacements and forces, or its lowest and highest first
  /// frequency.
  void choose_steps() {
    if (every_step_.size() <= 2) {
      steps_ = every_step_;
      return;
    }
    const auto found = overview().along(linear(scope_.applicable), every_step_);
    if (!found) {
      steps_ = every_step_;
      return;
    }
    std::map<std::string, std::pair<double, std::size_t>> extremes;
    const auto look = [&](const std::string& extreme, double size, std::size_t place) {
      auto& largest = extremes.try_emplace(extreme, size, place).first->second;
      largest = std::max(largest, {size, place});
    };
    for (const auto& [name, quantity] : *found) {
      const std::string kind = change_kind(name);
      for (std::size_t i = 0; i < quantity.values.size(); ++i) {
        const double size = std::abs(quantity.values[i]);
        if (kind == "displacement" || kind == "force" || (has_points_ && kind != "frequency"))
          look(kind, size, i);
        if (name == "frequency_Hz:1") look("highest", size, i), look("lowest", -size, i);
      }
    }
    for (const auto& [extreme, largest] : extremes) steps_.insert(step_at(largest.second));
  }

  /// @param place  among all that are looked at
  [[nodiscard]] std::size_t step_at(std::size_t place) const {
    return *std::next(every_step_.begin(), static_cast<std::ptrdiff_t>(place));
  }

  /// @returns false where the choice holds at every step that was not looked at before
  bool add_worst_step(const Elimination& found) {
    if (steps_ == every_step_ || found.chosen == scope_.applicable) return false;
    Effects whole = scope_.applicable, chosen = found.chosen;
    const bool lost = !(change_of_linear_theory() <= kLost);
    if (chosen.has(Effect::large_displacement) && !lost) {
      whole = linear(whole);
      chosen = linear(chosen);
    }
    MeshedScene& mesh = lost ? *coarse_ : overview();
    const auto full = mesh.along(whole, every_step_);
    if (!full) {
      steps_ = every_step_;
      return lost;
    }
    const auto other = mesh.along(chosen, every_step_);
    for (const std::size_t step : other ? std::set<std::size_t>() : every_step_) {
      if (!mesh.at(chosen, step)) return steps_.insert(step).second;
    }
    const LargestDifference worst = max_change(changes_between(*full, *other, size_));
    return worst.value > kSurelyWithin * tolerance_ && steps_.insert(step_at(worst.index)).second;
  }

  const EffectScope& scope_;
  double tolerance_;
  ModelScales size_;
  Effects negligible_;
  /// Of prismatic members one element is exact for loads at its ends.
  bool is_linear_exact_ = false, has_points_ = false;
  bool is_coarser_ = false, try_linearly_ = true, tried_linearly_ = false;
  std::optional<MeshedScene> coarsest_, coarse_, own_;
  std::set<std::size_t> every_step_, steps_;
};

}  // namespace

Elimination eliminate(const EffectScope& scope, const std::vector<Effect>& order,
                      Effects negligible, double tolerance, const ChangeWith& change_with) {
  return EliminationOf(scope, tolerance, change_with).run(order, negligible);
}

Elimination eliminate_by_measurement(const AnalysisKind& kind, const JsonView& analysis,
                                     const CaseModel& scene, const EffectScope& scope,
                                     double tolerance) {
  return Measurement(kind, analysis, scene, scope, tolerance).run();
}

void eliminate_near_tolerance(const AnalysisKind& kind, const JsonView& analysis,
                              const CaseModel& scene, const EffectScope& scope, double tolerance,
                              const std::vector<Effect>& near,
                              const std::pair<Effects, double>& beside, Elimination& found) {
  EffectScope left = scope;
  left.applicable = left.required = found.chosen;
  for (const Effect effect : near) left.required = left.required.without(effect);
  MeshedScene mesh(kind, analysis, scene, beside.first, scales_of(first_model(scene)));
  const ChangeWith change_with = [&](Effects active) {
    return beside.second + mesh.change(beside.first, active, {0});
  };
  const Elimination measured = eliminate(left, near, {}, tolerance, change_with);
  found.counters += mesh.counters;
  found.chosen = measured.chosen;
  for (const Effect effect : near) {
    const auto change = measured.change[static_cast<std::size_t>(effect)];
    if (!change || !std::isfinite(*change)) continue;
    found.change[static_cast<std::size_t>(effect)] = change;
    found.measured = found.measured.with(effect);
  }
}

std::vector<double> changes_at_start(const JsonView& analysis, CaseModel scene,
                                     const EffectScope& scope, const std::vector<Effect>& effects) {
  const Effects whole = scope.without(scope.applicable, Effect::large_displacement);
  const auto add_sample = [&](Effects active, bool vibrates, Recorder& record) {
    scene.effects = active;
    solver::ElastodynamicsOptions options = read_elastodynamics(analysis, scene);
    options.elastic_inertia = options.elastic_inertia && vibrates;
    options.gyroscopic = options.gyroscopic && vibrates;
    options.time.end = std::min(options.time.end, options.time.start + options.time.step);
    options.time.sample_times = {options.time.start};
    const solver::ElastodynamicsSolution solution = solver::solve_elastodynamics(options);
    if (!solution.outcome.solved()) return false;
    const solver::Model model = build_model(scene, 0);
    StateRecorder(model, "elastodynamics").record({solution.state.front()}, record);
    return true;
  };
  const auto samples = [&](Effects active) {
    Recorder record;
    const bool solved = add_sample(active, true, record) && add_sample(whole, false, record);
    return solved ? record.take_quantities() : Quantities();
  };
  const Quantities full = samples(whole);
  const ModelScales size = scales_of(build_model(scene, 0));
  std::vector<double> changes;
  for (const Effect effect : effects) {
    const Quantities other = samples(scope.without(whole, effect));
    const bool compared = !full.empty() && !other.empty();
    changes.push_back(compared ? max_change(changes_between(full, other, size)).value : kInfinite);
  }
  return changes;
}

std::optional<double> large_displacement_at_rest(const JsonView& analysis, const CaseModel& scene,
                                                 const std::vector<double>& times) {
  solver::ElastodynamicsOptions options = read_elastodynamics(analysis, scene);
  options.elastic_inertia = options.gyroscopic = false;
  options.time.sample_times = times;
  std::vector<Quantities> found;
  const solver::Model model = build_model(scene, 0);
  for (const auto& solve : {solver::solve_large_elastodynamics, solver::solve_elastodynamics}) {
    const solver::ElastodynamicsSolution solution = solve(options);
    if (!solution.outcome.solved()) return std::nullopt;
    Recorder record;
    for (const solver::StaticSolution& state : solution.state)
      StateRecorder(model, "elastodynamics").record({state}, record);
    found.push_back(record.take_quantities());
  }
  return max_change(changes_between(found[0], found[1], scales_of(model))).value;
}

}  // namespace trammel::harness
