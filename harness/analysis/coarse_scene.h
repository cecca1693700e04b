#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "harness/analysis/effect_changes.h"
#include "harness/analysis/registry.h"

/// Coarse models of a scene (a case whose effects are selected), which require less computing time
/// than the complete model. The work of a computation is estimated from its numbers of solves,
/// factorizations and element matrices.
namespace trammel::harness {

/// Returns the model of a case (scene) on a coarse mesh: at most `elements` elements per member,
/// and three triangles in a platform.
[[nodiscard]] CaseModel coarsen_scene(CaseModel scene, solver::Index elements);

/// Returns the number of unknowns of a model before constraints.
[[nodiscard]] double unknown_count(const solver::Model& model);

/// Returns the estimated work of a computation. The unit is the time of one solve divided by the
/// number of unknowns. A factorization of a planar frame counts as 8 solves. An element matrix
/// counts as one solve for 24 unknowns. Both weights are medians of measured times over the random
/// models of the tests.
[[nodiscard]] double estimated_work(const solver::Counters& counters, double unknowns);

/// Model of a case on a coarse mesh. Caches the results for each set of effects and each point of
/// the case's path.
class CoarseScene {
 public:
  CoarseScene(const AnalysisKind& kind, const JsonView& analysis, const CaseModel& scene,
              solver::Index elements)
      : kind_(kind),
        analysis_(analysis),
        scene_(coarsen_scene(scene, elements)),
        model_(model_at_path_start(scene_)),
        size_(typical_model_scales(model_)) {}

  /// Returns the largest relative change of the results at the points `steps` of the path if
  /// `all_effects` are replaced by `effects`. Returns infinity if a model has no solution at one of
  /// these points.
  [[nodiscard]] double max_result_change(solver::Effects all_effects, solver::Effects effects,
                                         const std::set<std::size_t>& steps);
  /// Returns the results at the points `steps` of the path; empty if the model has no solution at
  /// one of them.
  [[nodiscard]] std::optional<Quantities> results_at_steps(solver::Effects effects,
                                                           const std::set<std::size_t>& steps);

  [[nodiscard]] const ModelScales& model_scales() const { return size_; }
  [[nodiscard]] const solver::Model& model() const { return model_; }
  solver::Outcome outcome;  ///< outcome of the latest computation that had no solution
  solver::Counters counters;

 private:
  using ByStep = std::map<std::size_t, std::optional<Quantities>>;

  const std::optional<Quantities>& at(solver::Effects effects, std::size_t step);
  std::optional<Quantities> compute_at_step(solver::Effects effects, std::size_t step);

  const AnalysisKind& kind_;
  const JsonView& analysis_;
  CaseModel scene_;
  solver::Model model_;
  ModelScales size_;
  std::vector<std::pair<solver::Effects, ByStep>> runs_;
};

}  // namespace trammel::harness
