#include "harness/studies/effect_study.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "harness/analysis/coarse_scene.h"
#include "harness/analysis/registry.h"
#include "harness/analysis/size_estimate.h"
#include "harness/base/stopwatch.h"
#include "harness/base/timing.h"
#include "harness/input/reference_library.h"
#include "harness/scene/rethrow_as_input.h"
#include "harness/studies/discretization_error.h"
#include "solver/linear/system.h"

namespace trammel::harness {
namespace {

using solver::Effect;
using solver::Effects;

class Study {
 public:
  Study(const Document& document, const EffectStudyOptions& options)
      : document_(document), automatic_(apply_effects(document, Effects())), options_(options) {
    const auto requested = JsonView(document).find("effects");
    study_.tolerance = requested && requested->json().is_object()
                           ? (*requested)["auto"].number("tolerance")
                           : options.tolerance;
    automatic_.apply_patch(document.origin("").file, "",
                           Json{{"effects", {{"auto", {{"tolerance", study_.tolerance}}}}}});
    scene_ = read_case_model(automatic_);
    size_ = typical_model_scales(model_at_path_start(scene_));
    (void)solver::assemble(model_at_path_start(scene_));  // throws for an invalid model
    study_.scope = effect_scope(document_, scene_);
  }

  EffectStudy run() {
    const Stopwatch watch;
    study_.choice = choose_effects(automatic_, scene_);
    study_.deciding_cpu_s = watch.cpu_s();
    study_.full = compute(study_.scope.applicable);
    if (!study_.full.outcome.solved()) return std::move(study_);
    study_.chosen = compute(study_.choice.chosen);
    compare_meshes();
    for (const auto& [from, runs] :
         {std::pair(&study_.full, &study_.without_one), {&study_.chosen, &study_.without_chosen}})
      if (options_.measures_contributions || runs != &study_.without_one)
        for (const Effect effect : removable(from->effects))
          runs->push_back(compute(study_.scope.with_implied_effects(
                                      study_.scope.remove_with_dependents(from->effects, effect)),
                                  from->effects));
    if (options_.repeats > 0) measure_time();
    return std::move(study_);
  }

 private:
  EffectRun compute(Effects effects, Effects from = {}) {
    const Document given = apply_effects(document_, effects);
    const Stopwatch watch;
    const AnalysisResult result = analyze(given, references_, {.drawing = false});
    EffectRun run;
    run.effects = effects;
    run.left_out = from.without(effects);
    run.outcome = result.outcome;
    run.quantities = result.quantities;
    run.counters = result.counters;
    run.cpu_s = watch.cpu_s();
    scene_.effects = effects;
    run.work = estimated_work(result.counters, unknown_count(model_at_path_start(scene_)));
    if (run.outcome.solved()) {
      const Quantities& full = study_.full.quantities;
      run.changes = result_changes(full.empty() ? run.quantities : full, run.quantities, size_);
    } else {
      run.changes["solution"] = {std::numeric_limits<double>::infinity(), 0};
    }
    return run;
  }

  void compare_meshes() {
    const auto coarser = adjacent_refinement_level(document_, ErrorSource::mesh);
    if (!study_.chosen.outcome.solved() || !coarser || coarser->finer) return;
    const AnalysisResult result = analyze(apply_effects(coarser->document, study_.choice.chosen),
                                          references_, {.drawing = false});
    if (result.outcome.solved())
      study_.mesh_change =
          max_change(result_changes(study_.chosen.quantities, result.quantities, size_)).value;
  }

  std::vector<Effect> removable(Effects from) const {
    std::vector<Effect> effects;
    for (const Effect effect : from.without(study_.scope.required).list())
      if (!study_.scope.with_implied_effects(from.without(effect)).has(effect))
        effects.push_back(effect);
    return effects;
  }

  /// Measures in turns and in random order the computing times with all effects, with the chosen
  /// effects and without one effect. A slowdown of the machine therefore affects all of them.
  void measure_time() {
    std::vector<EffectRun*> runs = {&study_.full, &study_.chosen};
    for (EffectRun& run : study_.without_one) runs.push_back(&run);
    std::vector<std::function<void()>> works;
    for (const EffectRun* run : runs)
      works.emplace_back([this, document = apply_effects(document_, run->effects)] {
        (void)analyze(document, references_, {.drawing = false});
      });
    works.emplace_back(
        [this, scene = read_case_model(automatic_)] { (void)choose_effects(automatic_, scene); });
    const auto timings = measure_interleaved(works, {.repeats = options_.repeats}, nullptr);
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i]->cpu_s = timings[i].median_s;
    study_.deciding_cpu_s = timings.back().median_s;
  }

  const Document& document_;
  Document automatic_;
  EffectStudyOptions options_;
  CaseModel scene_;
  References references_;
  ModelScales size_;
  EffectStudy study_;
};

}  // namespace

bool EffectStudy::is_minimal() const {
  return std::ranges::none_of(without_chosen, [this](const EffectRun& run) {
    return std::ranges::any_of(run.left_out.list(), is_expensive) &&
           run.largest_change() <= tolerance;
  });
}

EffectStudy study_effects(const Document& document, const EffectStudyOptions& options) {
  if (!supports_effects(document))
    throw JsonView(document)["analysis"].error("this analysis does not support effects; expected " +
                                               analyses_with_effects());
  require_sufficient_memory(document);
  return rethrow_as_input_error(document, [&] { return Study(document, options).run(); });
}

}  // namespace trammel::harness
