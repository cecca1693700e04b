#include "harness/studies/effect_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "harness/analysis/registry.h"
#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"
#include "harness/base/timing.h"
#include "harness/input/reference_library.h"
#include "harness/scene/with_model_errors.h"
#include "solver/statics/buckling.h"

namespace trammel::harness {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// What a quantity is compared among; empty: it is not compared.
std::string kind_of(const std::string& quantity) {
  static const std::vector<std::pair<std::string, std::string>> kinds = {
      {"displacement_", "displacement"},
      {"rotation_rad", "rotation"},
      {"end_rotation_rad", "rotation"},
      {"reaction_moment_", "moment"},
      {"reaction_", "force"},
      {"axial_force_", "force"},
      {"shear_force_", "force"},
      {"bending_moment_", "moment"},
      {"frequency_Hz", "frequency"}};
  for (const auto& [start, kind] : kinds) {
    if (quantity.rfind(start, 0) == 0) return kind;
  }
  return "";
}

/// Of each kind, what its changes are measured by: not round-off.
std::map<std::string, double> scales_of(const Quantities& full, double size) {
  constexpr double kNothing = 1e-9;
  std::map<std::string, double> scale;
  for (const auto& [name, quantity] : full) {
    const std::string kind = kind_of(name);
    if (!kind.empty()) scale[kind] = std::max(scale[kind], max_abs(quantity.values));
  }
  const auto floor = [&](const char* kind, const char* beside, double arm) {
    if (scale.count(kind) + scale.count(beside) < 2) return;
    scale[kind] = std::max(scale[kind], kNothing * scale[beside] * arm);
  };
  floor("displacement", "rotation", size);
  floor("rotation", "displacement", 1 / size);
  floor("force", "moment", 1 / size);
  floor("moment", "force", size);
  return scale;
}

double size_of(const CaseModel& case_model) {
  const solver::Model model = build_model(case_model, 0);
  Eigen::Vector2d low = model.nodes.front().position, high = low;
  for (const solver::Node& node : model.nodes) {
    low = low.cwiseMin(node.position);
    high = high.cwiseMax(node.position);
  }
  return (high - low).norm();
}

class Study {
 public:
  Study(const Document& document, const EffectStudyOptions& options)
      : document_(document), options_(options) {
    const auto requested = JsonView(document).find("effects");
    study_.tolerance = requested && requested->json().is_object()
                           ? (*requested)["auto"].number("tolerance")
                           : options.tolerance;
    const CaseModel case_model = read_case_model(document_);
    size_ = size_of(case_model);
    study_.scope = effect_scope(document_, case_model);
    if (analysis_kind(document_) == "statics") {
      const solver::BucklingSolution buckling =
          solver::solve_buckling(solver::assemble(build_model(case_model, 0)), {1});
      if (buckling.outcome.solved() && buckling.load_factor.size() > 0)
        study_.load_over_buckling_load = 1 / buckling.load_factor[0];
    }
  }

  EffectStudy run() {
    decide();
    const solver::Effects all = study_.scope.applicable;
    study_.full = compute(all);
    if (!study_.full.outcome.solved()) return std::move(study_);
    study_.chosen = compute(study_.choice.chosen);
    const std::vector<solver::Effect> able = all.without(study_.scope.required).list();
    for (const solver::Effect effect : able) study_.singles.push_back(leave_out(all, {effect}));
    for (std::size_t i = 0; options_.pairs && i < able.size(); ++i) {
      for (std::size_t j = i + 1; j < able.size(); ++j) {
        study_.pairs.push_back(leave_out(all, {able[i], able[j]}));
      }
    }
    const solver::Effects chosen = study_.choice.chosen;
    for (const solver::Effect effect : chosen.without(study_.scope.required).list()) {
      study_.from_chosen.push_back(leave_out(chosen, {effect}));
    }
    if (options_.repeats > 0) measure_time();
    return std::move(study_);
  }

 private:
  void decide() {
    const Document automatic = [this] {
      Document changed = with_effects(document_, solver::Effects());
      changed.apply_patch(document_.origin("").file, "",
                          Json{{"effects", {{"auto", {{"tolerance", study_.tolerance}}}}}});
      return changed;
    }();
    const Stopwatch watch;
    study_.choice = choose_effects(automatic, read_case_model(automatic));
    study_.choice_cpu_s = watch.cpu_s();
  }

  EffectRun compute(solver::Effects effects) const {
    const AnalysisResult result = analyse(with_effects(document_, effects), references_, {false});
    EffectRun run{effects, result.outcome, result.quantities, result.counters, {}, 0, 0};
    if (run.outcome.solved()) {
      const Quantities& full = study_.full.quantities;
      run.changes = changes_between(full.empty() ? run.quantities : full, run.quantities, size_);
    } else {
      run.changes["solution"] = kInfinite;
    }
    return run;
  }

  Ablation leave_out(solver::Effects from, const std::vector<solver::Effect>& out) const {
    solver::Effects left = from;
    for (const solver::Effect effect : out) left = study_.scope.without(left, effect);
    return {out, compute(left)};
  }

  /// All sets in turns, in random order, so that what slows the machine slows all.
  void measure_time() {
    std::vector<EffectRun*> runs = {&study_.full, &study_.chosen};
    for (Ablation& ablation : study_.singles) runs.push_back(&ablation.run);
    std::vector<std::function<void()>> works;
    for (const EffectRun* run : runs) {
      works.emplace_back([this, document = with_effects(document_, run->effects)] {
        (void)analyse(document, references_, {false});
      });
    }
    const std::vector<Timing> timings =
        time_interleaved(works, {.repeats = options_.repeats}, nullptr);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs[i]->cpu_s = timings[i].median_s;
      runs[i]->cpu_spread = timings[i].spread() / 2;
    }
  }

  const Document& document_;
  EffectStudyOptions options_;
  References references_;
  double size_ = 1;
  EffectStudy study_;
};

}  // namespace

Changes changes_between(const Quantities& full, const Quantities& other, double size_m) {
  const auto scale = scales_of(full, size_m);
  Changes changes;
  for (const auto& [kind, by] : scale) changes[kind] = 0;
  for (const auto& [name, quantity] : full) {
    const std::string kind = kind_of(name);
    if (kind.empty()) continue;
    const auto found = other.find(name);
    double& largest_change = changes[kind];
    if (found == other.end()) {  // a part may have no such thing without the effect; a mode is lost
      if (kind == "frequency") largest_change = kInfinite;
      continue;
    }
    const auto by = [&, scale = scale.at(kind)](std::size_t i) {
      return kind == "frequency" ? std::abs(quantity.values[i]) : scale;
    };
    largest_change = std::max(largest_change,
                              largest_difference(quantity.values, found->second.values, by).value);
  }
  return changes;
}

double max_change(const Changes& changes) {
  double largest_change = 0;
  for (const auto& [kind, change] : changes) largest_change = std::max(largest_change, change);
  return largest_change;
}

bool EffectStudy::within_tolerance() const {
  return chosen.outcome.solved() && max_change(chosen.changes) <= tolerance;
}

bool EffectStudy::is_minimal() const {
  return std::all_of(from_chosen.begin(), from_chosen.end(), [this](const Ablation& ablation) {
    return !(max_change(ablation.run.changes) <= tolerance);
  });
}

EffectStudy study_effects(const Document& document, const EffectStudyOptions& options) {
  if (!knows_effects(document)) {
    throw JsonView(document)["analysis"].error("expected an analysis that knows effects: " +
                                               analyses_with_effects());
  }
  return with_model_errors(document, [&] { return Study(document, options).run(); });
}

}  // namespace trammel::harness
