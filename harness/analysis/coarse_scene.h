#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "harness/analysis/effect_changes.h"
#include "harness/analysis/registry.h"

/// Coarse models of a scene, and the work of computations by their counters.
namespace trammel::harness {

/// The scene with at most so many elements a member and a platform of three triangles.
[[nodiscard]] CaseModel coarsened(CaseModel scene, solver::Index elements);

/// Unknowns of a model before constraints.
[[nodiscard]] double unknowns_of(const solver::Model& model);

/// Work of a computation by its counters, in solves of one unknown: a factorization of a planar
/// frame takes as long as 8 solves, an element matrix as long as 24 unknowns of a solve. Both
/// weights are medians of times over the random scenes of the tests.
[[nodiscard]] double work_of(const solver::Counters& counters, double unknowns);

/// The scene on a coarse mesh: its results with sets of effects at steps of its path, each computed
/// once.
class CoarseScene {
 public:
  CoarseScene(const AnalysisKind& kind, const JsonView& analysis, const CaseModel& scene,
              solver::Index elements)
      : kind_(kind),
        analysis_(analysis),
        scene_(coarsened(scene, elements)),
        model_(first_model(scene_)),
        size_(scales_of(model_)) {}

  /// Largest relative change between two sets of effects; infinite without a solution.
  [[nodiscard]] double change(solver::Effects all, solver::Effects effects,
                              const std::set<std::size_t>& steps);
  /// Results at the steps one after the other; nothing if one of them has no solution.
  [[nodiscard]] std::optional<Quantities> along(solver::Effects effects,
                                                const std::set<std::size_t>& steps);

  [[nodiscard]] const ModelScales& size() const { return size_; }
  [[nodiscard]] const solver::Model& model() const { return model_; }
  solver::Outcome outcome;  ///< the last that is not solved
  solver::Counters counters;

 private:
  using ByStep = std::map<std::size_t, std::optional<Quantities>>;

  const std::optional<Quantities>& at(solver::Effects effects, std::size_t step);
  std::optional<Quantities> compute(solver::Effects effects, std::size_t step);

  const AnalysisKind& kind_;
  const JsonView& analysis_;
  CaseModel scene_;
  solver::Model model_;
  ModelScales size_;
  std::vector<std::pair<solver::Effects, ByStep>> runs_;
};

}  // namespace trammel::harness
