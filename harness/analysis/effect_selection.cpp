#include "harness/analysis/effect_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "harness/analysis/coarse_scene.h"
#include "harness/analysis/effect_changes.h"
#include "harness/analysis/effect_numbers.h"
#include "harness/motion/analyses.h"
#include "harness/scene/observables.h"
#include "solver/large/large_elastodynamics.h"
#include "solver/linear/modes.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Largest fraction of the remaining tolerance that a change of the results measured on a coarse
/// mesh may use. kForSecondOrder applies near the buckling load, where a coarse mesh is less
/// accurate.
constexpr double kForCoarseModel = 0.95, kForSecondOrder = 0.8;

class Selector {
 public:
  Selector(const AnalysisKind& kind, const JsonView& analysis, const CaseModel& scene,
           const EffectScope& scope, double tolerance)
      : kind_(kind),
        analysis_(analysis),
        scene_(scene),
        scope_(scope),
        tolerance_(tolerance),
        model_(model_at_path_start(scene)) {
    selection_.chosen = scope.applicable;
  }

  EffectSelection run() {
    const std::string name = kind_.name;
    ResponseScale scale = response_scale(name, analysis_, model_);
    if (name == "elastodynamics") scale = scale_of_motion();
    if (selection_.outcome.solved()) apply_numbers(scale);
    if (name == "statics") select_in_statics();
    if (name == "modes" && analysis_.has("rotating")) select_in_rotation();
    if (name == "elastodynamics" && selection_.outcome.solved()) select_in_motion();
    if (!selection_.outcome.solved()) selection_.chosen = scope_.applicable;
    selection_.chosen = scope_.with_implied_effects(selection_.chosen);
    if (selection_.chosen == scope_.applicable) selection_.change = 0;
    return selection_;
  }

 private:
  [[nodiscard]] double rest() const { return tolerance_ - selection_.change; }

  /// Returns the chosen effects without one effect and without its dependents.
  [[nodiscard]] Effects without(Effect effect) const {
    return scope_.remove_with_dependents(selection_.chosen, effect);
  }

  [[nodiscard]] bool can_leave_out(Effect effect) const {
    return selection_.chosen.has(effect) && !scope_.required.has(effect);
  }

  /// Removes an effect from the chosen effects if `change` is at most the fraction `share` of the
  /// remaining tolerance. `change` is the relative change of the results compared with those of the
  /// effects `full`.
  bool try_without(Effect effect, Effects full, double change, double share, bool is_measured) {
    EffectEvidence& evidence = selection_.of(effect);
    evidence.is_measured = is_measured;
    if (selection_.chosen == full) evidence.own = change;
    evidence.cumulative = selection_.change + change;
    if (!(change <= share * rest())) return false;
    selection_.chosen = without(effect);
    return true;
  }

  /// Removes effects by dimensionless numbers, while the sum of the estimated changes of the
  /// results is within a fraction of the tolerance. Expensive effects (a meshed platform,
  /// stiffening of a frame at rest) precede cheap ones. Expensive and cheap effects are each in
  /// ascending order of the estimated change.
  void apply_numbers(const ResponseScale& scale) {
    const EffectNumbers numbers = dimensionless_numbers(model_, scale);
    const auto change_of = [&](Effect effect) {
      // A suddenly applied load excites every mode, including the modes of stiff parts.
      const bool strikes = from_rest_ && effect != Effect::shear;
      return strikes ? kInfinite : numbers[static_cast<std::size_t>(effect)].change;
    };
    std::vector<Effect> order;
    for (const Effect effect : scope_.applicable.list()) {
      const auto& number = numbers[static_cast<std::size_t>(effect)].value;
      selection_.of(effect).number = number;
      const bool decides = effect != Effect::geometric_stiffening || is_frame_at_rest();
      if (number && decides && !scope_.required.has(effect)) order.push_back(effect);
    }
    std::ranges::stable_sort(order, {}, [&](Effect effect) {
      return std::pair(!is_expensive(effect), change_of(effect));
    });
    const bool is_measured_later =
        can_leave_out(Effect::large_displacement) || can_leave_out(Effect::inertia);
    for (const Effect effect : order) {
      const double change = change_of(effect);
      if (!can_leave_out(effect) || !std::isfinite(change)) continue;
      selection_.of(effect).own = change;
      selection_.of(effect).cumulative = selection_.change + change;
      const double share = !is_measured_later || is_expensive(effect) ? 0.75 : 0.1;
      if (selection_.change + change > share * tolerance_) continue;
      selection_.chosen = without(effect);
      selection_.change += change;
    }
  }

  [[nodiscard]] bool is_frame_at_rest() const {
    return std::string(kind_.name) == "modes" && !analysis_.has("rotating");
  }

  void add_cost(const solver::Counters& counters, const solver::Model& model) {
    selection_.work += estimated_work(counters, unknown_count(model));
  }

  /// Compares linear theory with large displacement on one element per member. One element per
  /// prismatic member is exact in linear theory. If linear theory is insufficient near a buckling
  /// load, compares second-order theory with large displacement on four elements per member, which
  /// reproduce buckling. On a path, only the steps with extreme results of linear theory are
  /// compared. Further steps at which the change exceeds the tolerance are then added.
  void select_in_statics() {
    CoarseScene single(kind_, analysis_, scene_, 1), finer(kind_, analysis_, scene_, 4);
    const Effects all = selection_.chosen, linear = without(Effect::geometric_stiffening);
    const Effects second = without(Effect::large_displacement);
    std::set<std::size_t> every;
    for (std::size_t step = 0; step < scene_.path_point_count(); ++step) every.insert(step);
    const auto overview = single.results_at_steps(linear, every);
    if (!overview) {
      selection_.outcome = single.outcome;
    } else {
      std::set<std::size_t> steps = every.size() > 2 ? extremes(*overview) : every;
      const auto try_theory = [&](CoarseScene& coarse, Effect effect, Effects effects,
                                  double share) {
        const double change = change_along(coarse, all, effects, every, steps);
        const bool is_enough = try_without(effect, all, change, share, true);
        if (is_enough) selection_.change += change;
        return is_enough;
      };
      // Second-order theory neglects the shortening of a rotated member. Relative to the
      // deflection, the shortening is of the order of the rotation. Second-order theory saves load
      // steps only if the ratio of axial force to buckling load exceeds kManySteps.
      constexpr double kManySteps = 0.1;
      const Deflection size = deflection(*overview);
      if (!try_theory(single, Effect::geometric_stiffening, linear, kForCoarseModel) &&
          size.rotation <= rest() && size.compression >= kManySteps)
        try_theory(finer, Effect::large_displacement, second, kForSecondOrder);
    }
    add_cost(single.counters, single.model());
    add_cost(finer.counters, finer.model());
  }

  /// Returns the largest relative change of the results at `steps` if the effects `all` are
  /// replaced by `effects`. Adds to `steps` those steps of the path at which the change exceeds the
  /// permitted fraction of the tolerance.
  double change_along(CoarseScene& coarse, Effects all, Effects effects,
                      const std::set<std::size_t>& every, std::set<std::size_t>& steps) const {
    for (;;) {
      const double change = coarse.max_result_change(all, effects, steps);
      if (!(change <= kForCoarseModel * rest()) || steps == every) return change;
      const auto full = coarse.results_at_steps(all, every),
                 other = coarse.results_at_steps(effects, every);
      if (!full || !other) return kInfinite;
      const auto worst = max_change(result_changes(*full, *other, coarse.model_scales()));
      if (worst.value <= kForCoarseModel * rest() || !steps.insert(worst.index).second)
        return std::max(change, worst.value);
    }
  }

  struct Deflection {
    double rotation = 0;     ///< largest rotation of nodes and of chords [rad]
    double compression = 0;  ///< largest axial force / buckling load of a cantilever
  };

  [[nodiscard]] Deflection deflection(const Quantities& quantities) const {
    double shortest = kInfinite, displacement = 0;
    Deflection size;
    for (const auto& [name, quantity] : quantities) {
      const std::string kind = quantity_group(name);
      double& largest = kind == "rotation" ? size.rotation : displacement;
      if (kind == "rotation" || kind == "displacement")
        largest = std::max(largest, max_abs(quantity.values));
    }
    for (const solver::Member& member : model_.members) {
      const double length = member_length(model_, member);
      shortest = std::min(shortest, length);
      const auto force = quantities.find("axial_force_N:" + member.name + ".start");
      if (member.section.EI > 0 && force != quantities.end())
        size.compression =
            std::max(size.compression,
                     max_abs(force->second.values) /
                         (std::pow(std::numbers::pi / (2 * length), 2) * member.section.EI));
    }
    size.rotation = std::max(size.rotation, displacement / shortest);
    return size;
  }

  /// Returns the indices of the largest displacement and of the largest force over the points of a
  /// path, or over the samples of a motion.
  static std::set<std::size_t> extremes(const Quantities& quantities) {
    std::map<std::string, std::pair<double, std::size_t>> largest;
    for (const auto& [name, quantity] : quantities) {
      const std::string kind = quantity_group(name);
      if (kind != "displacement" && kind != "force") continue;
      auto& extreme = largest.try_emplace(kind, 0.0, 0).first->second;
      for (std::size_t i = 0; i < quantity.values.size(); ++i)
        extreme = std::max(extreme, {std::abs(quantity.values[i]), i});
    }
    std::set<std::size_t> steps;
    for (const auto& [kind, extreme] : largest) steps.insert(extreme.second);
    return steps;
  }

  /// Removes, if the tolerance permits it, gyroscopic terms, which make the eigenvalue problem
  /// quadratic, and then geometric stiffening by rotation.
  void select_in_rotation() {
    const auto members = std::max<solver::Index>(std::ssize(model_.members), 1);
    CoarseScene coarse(kind_, analysis_, scene_,
                       2 + analysis_.get<solver::Index>("count", 0) / members);
    // Largest ratio of the numbers of unknowns of coarse and full model. Below this ratio, two
    // coarse computations cost less than the removal of one effect saves.
    constexpr double kPays = 0.25;
    if (unknown_count(coarse.model()) > kPays * unknown_count(model_)) return;
    for (const Effect effect : {Effect::gyroscopic, Effect::geometric_stiffening}) {
      if (!can_leave_out(effect)) continue;
      const double change = coarse.max_result_change(selection_.chosen, without(effect), {0});
      if (try_without(effect, selection_.chosen, change, kForCoarseModel, true))
        selection_.change += change;
    }
    add_cost(coarse.counters, coarse.model());
  }

  /// Computes the first natural frequency and its damping ratio at the start of a motion, on a mesh
  /// of one element per link.
  ResponseScale scale_of_motion() {
    if (const auto history = analysis_.find("load_history"))
      throw history->error(
          "automatic effects require a constant load; a load pulse may fall between the times at "
          "which the change of the results by an effect is measured");
    CaseModel coarse = coarsen_scene(scene_, 1);
    coarse.effects = scope_.remove_with_dependents(scope_.applicable, Effect::large_displacement);
    coarse_model_ = build_model(coarse, 0);
    options_ = read_elastodynamics_options(analysis_, coarse);
    // Up to three of the four modes are rigid-body modes.
    const auto modes = solver::solve_modes(solver::assemble(coarse_model_), {.count = 4});
    add_cost(modes.counters, coarse_model_);
    selection_.outcome = modes.outcome;
    if (!modes.outcome.solved()) return {};
    const auto first = std::ranges::find_if(modes.frequency, [](double f) { return f > 0; });
    if (first == modes.frequency.end()) {
      selection_.outcome = {solver::Status::singular, "the model cannot vibrate"};
      return {};
    }
    const double omega = 2 * std::numbers::pi * *first;
    damping_ = solver::damping_ratio(options_.damping, omega);
    frequency_ratio_ = path_rate() / omega;
    from_rest_ = !options_.time.quasi_static_start;
    const double duration = options_.time.end - options_.time.start;
    lasting_ =
        damping_ > 0 ? std::min(duration, 1 / (std::numbers::e * damping_ * omega)) : duration;
    phase_ = std::max(1.0, omega * lasting_ / 2);
    const double phase = vibrates() ? phase_ : 1;
    return {.phase = phase, .platform = phase};
  }

  /// @returns true if a sudden start or a fast path excites elastic vibration. A change of the
  ///   frequency of this vibration then shifts its phase.
  [[nodiscard]] bool vibrates() const {
    return from_rest_ || frequency_ratio_ * frequency_ratio_ > 0.1;
  }

  /// Returns the angular frequency of the path [rad/s]: the ratio of largest acceleration to
  /// largest velocity.
  [[nodiscard]] double path_rate() const {
    constexpr int kSamples = 64;
    double velocity = 0, acceleration = 0;
    const Eigen::Vector3d unit(1, 1, solver::platform_radius(options_.design.geometry));
    for (int i = 0; i <= kSamples; ++i) {
      const double share = static_cast<double>(i) / kSamples;
      const solver::TrajectoryPoint point = at(
          options_.path, options_.time.start + share * (options_.time.end - options_.time.start));
      velocity = std::max(velocity, point.velocity.cwiseProduct(unit).norm());
      acceleration = std::max(acceleration, point.acceleration.cwiseProduct(unit).norm());
    }
    return velocity > 0 ? acceleration / velocity : 0;
  }

  /// Removes inertia, large displacement, gyroscopic terms and damping if the tolerance permits it.
  void select_in_motion() {
    /// Relative change by large displacement above which results of linear theory are meaningless.
    constexpr double kLost = 0.5;
    CoarseScene coarse(kind_, analysis_, scene_, 1);
    select_inertia(coarse);
    if (const std::optional<double> change = change_of_theory()) {
      if (!scope_.applicable.has(Effect::large_displacement)) {
        selection_.beyond_tier = change;
      } else if (try_without(Effect::large_displacement, selection_.chosen, *change,
                             kForCoarseModel, true)) {
        selection_.change += *change;
      } else if (*change > kLost) {
        selection_.chosen = scope_.applicable;
      }
    }
    // A computation with large displacement includes gyroscopic terms without additional computing
    // time.
    if (!selection_.chosen.has(Effect::large_displacement) &&
        selection_.chosen.has(Effect::inertia)) {
      measure_without(coarse, Effect::gyroscopic);
      measure_without(coarse, Effect::damping);
    }
    add_cost(coarse.counters, coarse.model());
  }

  /// Removes inertia if the path is slow compared with the first natural frequency. The relative
  /// change of the results is at most r^2 + 2 zeta r. Here r is the ratio of path frequency to
  /// first natural frequency, and zeta the damping ratio of the first mode. If the bound is
  /// inconclusive, measures the change on the coarse model.
  void select_inertia(CoarseScene& coarse) {
    constexpr double kSurelyWithin = 0.25, kSurelyBeyond = 10;
    const double r = frequency_ratio_, bound = r * r + 2 * damping_ * r;
    selection_.of(Effect::damping).number = damping_;
    selection_.of(Effect::inertia).number = r * r;
    if (from_rest_ || !can_leave_out(Effect::inertia)) return;
    if (try_without(Effect::inertia, selection_.chosen, bound, kSurelyWithin, false)) {
      selection_.change += bound;
    } else if (bound <= kSurelyBeyond * rest()) {
      measure_without(coarse, Effect::inertia);
    }
  }

  /// Removes an effect if the resulting change of the motion is within the tolerance. The change is
  /// measured by linear theory on the coarse mesh.
  void measure_without(CoarseScene& coarse, Effect effect) {
    if (!can_leave_out(effect)) return;
    const auto linear = [&](Effects set) {
      return scope_.remove_with_dependents(set, Effect::large_displacement);
    };
    const double change =
        coarse.max_result_change(linear(selection_.chosen), linear(without(effect)), {0});
    if (try_without(effect, selection_.chosen, change, kForCoarseModel, true))
      selection_.change += change;
  }

  /// Returns the relative change of the results of a motion by large displacement. If the motion
  /// starts quasi-statically, the change is measured on the equilibria at the times with extreme
  /// results. These equilibria include loads, weight and nominal inertia. If the motion starts
  /// suddenly, the change is measured on the first part of the motion. The change grows with time
  /// during the vibration.
  std::optional<double> change_of_theory() {
    /// A vibration doubles the quasi-static change (kSwing). After a sudden start, only the
    /// fraction kShortened of the duration is simulated.
    constexpr double kSwing = 2, kShortened = 0.125;
    solver::ElastodynamicsOptions options = options_;
    const bool moves = selection_.chosen.has(Effect::inertia);
    const double duration = options.time.end - options.time.start;
    options.time.adaptive.reset();
    std::vector<double>& times = options.time.sample_times;
    double growth = !moves ? 1 : kSwing * (vibrates() ? 1 + phase_ : 1);
    if (from_rest_ && moves) {
      options.time.end = options.time.start + kShortened * duration;
      std::erase_if(times, [&](double time) { return time > options.time.end; });
      growth = std::max(1.0, lasting_ / (kShortened * duration));
    } else {
      options.elastic_inertia = options.gyroscopic = false;
      const auto overview = equilibria(solver::solve_elastodynamics, options);
      if (!overview) return std::nullopt;
      std::vector<double> extreme_times;
      for (const std::size_t sample : extremes(*overview)) extreme_times.push_back(times[sample]);
      times = extreme_times;
    }
    const auto exact = equilibria(solver::solve_large_elastodynamics, options);
    const auto linear = equilibria(solver::solve_elastodynamics, options);
    if (!exact || !linear) return std::nullopt;
    return growth *
           max_change(result_changes(*exact, *linear, typical_model_scales(coarse_model_))).value;
  }

  template <class Solve>
  std::optional<Quantities> equilibria(Solve solve, const solver::ElastodynamicsOptions& options) {
    try {
      const solver::ElastodynamicsSolution solution = solve(options);
      add_cost(solution.summary.counters, coarse_model_);
      if (!solution.outcome.solved()) return std::nullopt;
      Recorder record;
      for (const solver::StaticSolution& state : solution.state)
        StateRecorder(coarse_model_, "elastodynamics").record({state}, record);
      return record.take_quantities();
    } catch (const solver::ModelError&) {  // `solve` does not support `options`
      return std::nullopt;
    }
  }

  const AnalysisKind& kind_;
  const JsonView& analysis_;
  const CaseModel& scene_;
  const EffectScope& scope_;
  double tolerance_;
  solver::Model model_;
  EffectSelection selection_;
  // The following data are only used for a motion along a path.
  solver::Model coarse_model_;
  solver::ElastodynamicsOptions options_;
  double damping_ = 0, frequency_ratio_ = 0, phase_ = 1, lasting_ = 0;
  bool from_rest_ = false;
};

}  // namespace

EffectSelection select_effects(const AnalysisKind& kind, const JsonView& analysis,
                               const CaseModel& scene, const EffectScope& scope, double tolerance) {
  return Selector(kind, analysis, scene, scope, tolerance).run();
}

bool is_expensive(Effect effect) {
  static constexpr Effects kExpensive = Effects()
                                            .with(Effect::large_displacement)
                                            .with(Effect::geometric_stiffening)
                                            .with(Effect::inertia)
                                            .with(Effect::damping)
                                            .with(Effect::gyroscopic)
                                            .with(Effect::platform_flexibility);
  return kExpensive.has(effect);
}

}  // namespace trammel::harness
