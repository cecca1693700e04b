#pragma once

#include <array>
#include <optional>

#include "harness/analysis/registry.h"

/// Selects the physical effects that the results of a case require within a tolerance.
///
/// Cheap effects change coefficients but neither matrix sizes nor numbers of steps: axial
/// flexibility, shear, rotary inertia, joint compliance, the mass of links and gravity. Cheap
/// effects are removed by closed-form dimensionless numbers, without any computation. In case of
/// doubt, cheap effects are kept.
///
/// Expensive effects are large displacement, geometric stiffening, inertia with damping, gyroscopic
/// terms and a meshed platform. The change of the results by such an effect is measured on a coarse
/// model. The change is only measured if the measurement costs less time than the removal of the
/// effect may save. The effect with the largest saving is measured first. Without a measurement,
/// dimensionless numbers decide about the removal.
namespace trammel::harness {

/// Evidence for the influence of one physical effect on the results.
struct EffectEvidence {
  std::optional<double> number;  ///< dimensionless number of the effect
  std::optional<double> own;     ///< relative change if only this effect is removed
  /// Relative change of the results if this effect is removed together with all effects that were
  /// removed before it.
  std::optional<double> cumulative;
  /// True if the changes of the results are measured on a coarse model; false if the changes are
  /// upper bounds.
  bool is_measured = false;
};

struct EffectSelection {
  /// Outcome of the coarse model with all effects. If the coarse model is not solved, all effects
  /// are kept.
  solver::Outcome outcome;
  solver::Effects chosen;
  std::array<EffectEvidence, solver::kEffectCount> evidence;
  /// Relative change of the results if the chosen effects replace all effects: sum of the measured
  /// changes, and of bounds for the other changes.
  double change = 0;
  /// Relative change of the results by large displacement; empty if the analysis can compute large
  /// displacement or if there is no estimate.
  std::optional<double> beyond_tier;
  /// Computing work of the selection, as defined by `estimated_work` in coarse_scene.h.
  double work = 0;

  [[nodiscard]] EffectEvidence& of(solver::Effect effect) {
    return evidence[static_cast<std::size_t>(effect)];
  }
};

[[nodiscard]] EffectSelection select_effects(const AnalysisKind& kind, const JsonView& analysis,
                                             const CaseModel& scene, const EffectScope& scope,
                                             double tolerance);

/// Returns true for expensive effects, which change matrix sizes or numbers of steps.
[[nodiscard]] bool is_expensive(solver::Effect effect);

}  // namespace trammel::harness
