#include "harness/analysis/coarse_scene.h"

#include <algorithm>
#include <limits>

#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"

namespace trammel::harness {
namespace {

using solver::Effects;

/// Returns pointers to the element counts of all members and links.
std::vector<solver::Index*> find_element_counts(CaseModel& scene) {
  std::vector<solver::Index*> counts;
  for (solver::Member& member : scene.structure.members) counts.push_back(&member.elements);
  if (!scene.manipulator) return counts;
  for (auto* links : {&scene.manipulator->proximal, &scene.manipulator->distal})
    for (solver::LinkDesign& link : *links) counts.push_back(&link.elements);
  return counts;
}

}  // namespace

CaseModel coarsen_scene(CaseModel scene, solver::Index elements) {
  scene.estimates_large_displacement = true;
  for (solver::Index* count : find_element_counts(scene)) *count = std::min(*count, elements);
  if (!scene.manipulator || scene.manipulator->platform.pin_radius > 0) return scene;
  scene.manipulator->platform.refinements = 0;
  scene.manipulator->platform.six_nodes = false;
  return scene;
}

double unknown_count(const solver::Model& model) {
  double unknowns = 3 * static_cast<double>(model.nodes.size());
  for (const solver::Member& member : model.members)
    unknowns += 3 * static_cast<double>(member.elements - 1);
  return unknowns;
}

double estimated_work(const solver::Counters& counters, double unknowns) {
  constexpr double kFactorization = 8, kElement = 24;
  return unknowns * (kFactorization * static_cast<double>(counters.factorizations) +
                     static_cast<double>(counters.solves)) +
         kElement * static_cast<double>(counters.element_evaluations);
}

double CoarseScene::max_result_change(Effects all_effects, Effects effects,
                                      const std::set<std::size_t>& steps) {
  const auto full = results_at_steps(all_effects, steps), other = results_at_steps(effects, steps);
  if (!full || !other) return std::numeric_limits<double>::infinity();
  return max_change(result_changes(*full, *other, size_)).value;
}

std::optional<Quantities> CoarseScene::results_at_steps(Effects effects,
                                                        const std::set<std::size_t>& steps) {
  Quantities all;
  for (const std::size_t step : steps) {
    const auto& result = at(effects, step);
    if (!result) return std::nullopt;
    for (const auto& [name, quantity] : *result) {
      auto& values = all[name].values;
      values.insert(values.end(), quantity.values.begin(), quantity.values.end());
    }
  }
  return all;
}

const std::optional<Quantities>& CoarseScene::at(Effects effects, std::size_t step) {
  const auto is_its = [&](const auto& run) { return run.first == effects; };
  auto& by_step = find_or_add(runs_, is_its, {effects, {}}).second;
  const auto known = by_step.find(step);
  return known != by_step.end()
             ? known->second
             : by_step.emplace(step, compute_at_step(effects, step)).first->second;
}

std::optional<Quantities> CoarseScene::compute_at_step(Effects effects, std::size_t step) {
  Recorder record;
  scene_.effects = effects;
  try {
    const auto* const along_path = std::get_if<AnalysePath*>(&kind_.of_scene);
    const StepResult result =
        along_path != nullptr
            ? (*along_path)(analysis_, scene_, false, record)
            : std::get<AnalyseStep*>(kind_.of_scene)(analysis_, scene_, step, false, record);
    counters += result.counters;
    if (result.outcome.solved()) return record.take_quantities();
    outcome = outcome_at_path_point(scene_, step, result.outcome);
  } catch (const solver::ModelError& error) {
    // Removal of an effect may make the model invalid. The changed model then counts as unsolved.
    // The first computation includes all effects, so that its error is an error of the case.
    if (runs_.size() == 1) throw;
    outcome = {solver::Status::singular, error.what()};
  } catch (const InputError& error) {  // for example, fewer modes than damping ratios
    if (runs_.size() == 1) throw;
    outcome = {solver::Status::singular, error.what()};
  }
  return std::nullopt;
}

}  // namespace trammel::harness
