#pragma once

#include <array>
#include <optional>
#include <string>

#include "harness/analysis/registry.h"

/// Selection of the effects that a scene requires within a tolerance.
///
/// Free effects change coefficients but neither sizes nor steps: axial flexibility, shear, rotary
/// inertia, joint compliance, the mass of links and gravity. Closed-form numbers leave them out;
/// in doubt they stay, and none of them costs a computation. Expensive effects are large
/// displacement, geometric stiffening, inertia with damping, gyroscopic terms and a meshed
/// platform. They are measured on a coarse model, the one that saves most first, if the measurement
/// costs less than it may save; otherwise their numbers decide.
namespace trammel::harness {

/// Evidence for one effect.
struct EffectEvidence {
  std::optional<double> number;      ///< dimensionless
  std::optional<double> own;         ///< relative change of the results without it alone
  std::optional<double> cumulative;  ///< ... and without those left out before it
  bool is_measured = false;          ///< on a coarse model; otherwise the changes are bounds
};

struct EffectSelection {
  solver::Outcome outcome;  ///< of the coarse model with all effects; unsolved: every effect stays
  solver::Effects chosen;
  std::array<EffectEvidence, solver::kEffectCount> evidence;
  double change = 0;  ///< of the chosen set from all effects: sum of measurements and bounds
  /// Change by large displacement where the analysis cannot compute it; relative.
  std::optional<double> beyond_tier;
  double work = 0;  ///< of deciding, see `work_of` of coarse_scene.h

  [[nodiscard]] EffectEvidence& of(solver::Effect effect) {
    return evidence[static_cast<std::size_t>(effect)];
  }
};

[[nodiscard]] EffectSelection select_effects(const AnalysisKind& kind, const JsonView& analysis,
                                             const CaseModel& scene, const EffectScope& scope,
                                             double tolerance);

/// @returns whether an effect changes sizes or steps, not coefficients alone
[[nodiscard]] bool is_expensive(solver::Effect effect);

}  // namespace trammel::harness
