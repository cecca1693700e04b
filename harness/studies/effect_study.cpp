#include "harness/studies/effect_study.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "harness/analysis/registry.h"
#include "harness/analysis/size_estimate.h"
#include "harness/base/stopwatch.h"
#include "harness/base/timing.h"
#include "harness/input/reference_library.h"
#include "harness/scene/with_model_errors.h"
#include "solver/linear/buckling.h"
#include "solver/model/model.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class Study {
 public:
  Study(const Document& document, const EffectStudyOptions& options)
      : document_(document), options_(options) {
    const auto requested = JsonView(document).find("effects");
    study_.tolerance = requested && requested->json().is_object()
                           ? (*requested)["auto"].number("tolerance")
                           : options.tolerance;
    const CaseModel case_model = read_case_model(document_);
    size_ = scales_of(build_model(case_model, 0));
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
    const Effects all = study_.scope.applicable;
    study_.full = compute(all);
    if (!study_.full.outcome.solved()) return std::move(study_);
    study_.chosen = compute(study_.choice.chosen);
    const std::vector<Effect> able = removable(all);
    for (const Effect effect : options_.pairs ? able : std::vector<Effect>())
      study_.singles.push_back(leave_out(all, {effect}));
    for (std::size_t i = 0; options_.pairs && i < able.size(); ++i) {
      for (std::size_t j = i + 1; j < able.size(); ++j) {
        study_.pairs.push_back(leave_out(all, {able[i], able[j]}));
      }
    }
    const Effects chosen = study_.choice.chosen;
    for (const Effect effect : removable(chosen)) {
      study_.from_chosen.push_back(leave_out(chosen, {effect}));
    }
    if (options_.repeats > 0) measure_time();
    return std::move(study_);
  }

 private:
  void decide() {
    automatic_ = with_effects(document_, Effects());
    automatic_.apply_patch(document_.origin("").file, "",
                           Json{{"effects", {{"auto", {{"tolerance", study_.tolerance}}}}}});
    const CaseModel scene = read_case_model(automatic_);  // which a run reads in any case
    const Stopwatch watch;
    study_.choice = choose_effects(automatic_, scene);
    study_.choice_cpu_s = watch.cpu_s();
  }

  EffectRun compute(Effects effects) const {
    const Document given = with_effects(document_, effects);
    const Stopwatch watch;
    const AnalysisResult result = analyse(given, references_, {false});
    EffectRun run{effects, result.outcome, result.quantities, result.counters, {}, watch.cpu_s(),
                  0};
    if (run.outcome.solved()) {
      const Quantities& full = study_.full.quantities;
      run.changes = changes_between(full.empty() ? run.quantities : full, run.quantities, size_);
    } else {
      run.changes["solution"] = {kInfinite, 0};
    }
    return run;
  }

  std::vector<Effect> removable(Effects from) const {
    std::vector<Effect> effects;
    for (const Effect effect : from.without(study_.scope.required).list())
      if (!study_.scope.completed(from.without(effect)).has(effect)) effects.push_back(effect);
    return effects;
  }

  Ablation leave_out(Effects from, const std::vector<Effect>& out) const {
    Effects left = from;
    for (const Effect effect : out) left = study_.scope.without(left, effect);
    return {out, compute(study_.scope.completed(left))};
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
    works.emplace_back(
        [this, scene = read_case_model(automatic_)] { (void)choose_effects(automatic_, scene); });
    const std::vector<Timing> timings =
        time_interleaved(works, {.repeats = options_.repeats}, nullptr);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs[i]->cpu_s = timings[i].median_s;
      runs[i]->cpu_spread = timings[i].spread() / 2;
    }
    study_.choice_cpu_s = timings.back().median_s;
  }

  const Document& document_;
  Document automatic_;
  EffectStudyOptions options_;
  References references_;
  ModelScales size_;
  EffectStudy study_;
};

}  // namespace

bool EffectStudy::within_tolerance() const {
  return chosen.outcome.solved() && max_change(chosen.changes).value <= tolerance;
}

bool EffectStudy::is_minimal() const {
  return std::ranges::all_of(from_chosen, [this](const Ablation& ablation) {
    return !(max_change(ablation.run.changes).value <= tolerance);
  });
}

EffectStudy study_effects(const Document& document, const EffectStudyOptions& options) {
  if (!knows_effects(document)) {
    throw JsonView(document)["analysis"].error("expected an analysis that knows effects: " +
                                               analyses_with_effects());
  }
  require_fits(document);
  return with_model_errors(document, [&] { return Study(document, options).run(); });
}

}  // namespace trammel::harness
