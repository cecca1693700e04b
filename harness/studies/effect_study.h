#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_changes.h"
#include "harness/input/document.h"

/// Measures effects: the scene with all of them, with the selected ones, and without each.
namespace trammel::harness {

/// The scene with a set of effects.
struct EffectRun {
  solver::Effects effects, left_out;
  solver::Outcome outcome;
  Quantities quantities;
  solver::Counters counters;
  double work = 0;   ///< see `work_of`
  Changes changes;   ///< from the scene with all effects
  double cpu_s = 0;  ///< median of the repeats; without them of one run

  /// Largest change; infinite without a solution.
  [[nodiscard]] double change() const { return max_change(changes).value; }
};

struct EffectStudy {
  EffectScope scope;
  EffectChoice choice;
  double tolerance = 0;
  EffectRun full, chosen;
  /// Change of the results of the chosen set from half the elements to all, which is more than the
  /// error of the mesh; empty if no member has two elements.
  std::optional<double> mesh_change;
  double deciding_cpu_s = 0;
  std::vector<EffectRun> without_one;     ///< the full set without each effect: own contributions
  std::vector<EffectRun> without_chosen;  ///< the chosen set without each effect that may go

  [[nodiscard]] bool within_tolerance() const { return chosen.change() <= tolerance; }
  /// @returns whether no expensive effect of the chosen set can be removed
  [[nodiscard]] bool is_minimal() const;
  /// Work of deciding and of the chosen set over that of the full set.
  [[nodiscard]] double work_ratio() const {
    return (choice.automatic->work + chosen.work) / full.work;
  }
};

struct EffectStudyOptions {
  double tolerance = 0.01;
  int repeats = 7;  ///< of each set in turns after one for warming up; 0: not timed
};

/// @param document  a case whose analysis has effects. Its own tolerance has precedence.
/// @throws InputError  if the analysis has no effects or the model is invalid.
[[nodiscard]] EffectStudy study_effects(const Document& document,
                                        const EffectStudyOptions& options);

}  // namespace trammel::harness
