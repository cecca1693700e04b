#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "harness/analysis/registry.h"

/// Which effects a scene calls for: one after the other is left out for as long as the results stay
/// within the tolerance of the whole scene.
namespace trammel::harness {

/// How far the results with these effects are from those of the whole scene, relative; infinite
/// where they are none.
using ChangeWith = std::function<double(solver::Effects active)>;

struct Elimination {
  solver::Outcome outcome;  ///< of the whole scene; without a solution every effect stays
  solver::Effects chosen;
  /// By effect: how far the results were off when it was left out beside all that was off then.
  std::array<std::optional<double>, solver::kEffectCount> change;
  solver::Effects measured;  ///< whose change is no estimate
  solver::Counters counters;
};

/// @param order  what is tried first; an effect's dependents go before it
/// @param negligible  what is tried at once before all else
[[nodiscard]] Elimination eliminate(const EffectScope& scope,
                                    const std::vector<solver::Effect>& order,
                                    solver::Effects negligible, double tolerance,
                                    const ChangeWith& change_with);

/// By running the analysis, which goes step by step, with and without each effect: on a mesh as
/// coarse as keeps the physics, and on the scene's own where the coarse one comes near the
/// tolerance; along a path at the extremes of linear theory, and at any other pose where the choice
/// turns out to be off by more; over frequencies, on the scene's own mesh, in the same way. Where
/// large displacement stays, the others are tried in linear theory first, and what is left is
/// compared with the whole scene. Peaks between the frequencies are not searched.
[[nodiscard]] Elimination eliminate_by_measurement(const AnalysisKind& kind,
                                                   const JsonView& analysis, const CaseModel& scene,
                                                   const EffectScope& scope, double tolerance);

/// What estimates kept, of some effects that they put near the tolerance: by running the analysis
/// without each of them.
/// @param beside  what the runs are compared with, and what that is off the whole scene at most
/// @param found  by estimates; left as it is where one of the two has no solution
void eliminate_near_tolerance(const AnalysisKind& kind, const JsonView& analysis,
                              const CaseModel& scene, const EffectScope& scope, double tolerance,
                              const std::vector<solver::Effect>& near,
                              const std::pair<solver::Effects, double>& beside, Elimination& found);

/// What effects are worth where load and inertia set in at once: by the first sample, in which
/// inertia alone resists, beside what the loads do statically; infinite without a solution.
/// @returns of each of `effects`
[[nodiscard]] std::vector<double> changes_at_start(const JsonView& analysis, CaseModel scene,
                                                   const EffectScope& scope,
                                                   const std::vector<solver::Effect>& effects);

/// What geometric stiffening and large displacement change of the motion without vibration, under
/// loads, weight and nominal inertia at these times of the path; nothing without a solution.
[[nodiscard]] std::optional<double> large_displacement_at_rest(const JsonView& analysis,
                                                               const CaseModel& scene,
                                                               const std::vector<double>& times);

}  // namespace trammel::harness
