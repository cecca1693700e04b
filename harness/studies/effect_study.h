#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_changes.h"
#include "harness/input/document.h"

/// Measures effects: compares the scene with all effects, with the selected ones, and without each
/// effect.
namespace trammel::harness {

/// Run of the scene with a set of effects.
struct EffectRun {
  solver::Effects effects, left_out;
  solver::Outcome outcome;
  Quantities quantities;
  solver::Counters counters;
  double work = 0;   ///< see `work_of`
  Changes changes;   ///< changes of the results, relative to the scene with all effects
  double cpu_s = 0;  ///< median of the repeats; of one run without repeats

  /// Returns the largest change; infinite without a solution.
  [[nodiscard]] double change() const { return max_change(changes).value; }
};

struct EffectStudy {
  EffectScope scope;
  EffectChoice choice;
  double tolerance = 0;
  EffectRun full, chosen;
  /// Change of the results of the chosen set from half the elements to all elements. It exceeds the
  /// error of the mesh. Empty if no member has two elements.
  std::optional<double> mesh_change;
  double deciding_cpu_s = 0;
  std::vector<EffectRun> without_one;     ///< the full set without each effect: separate
                                          ///< contributions
  std::vector<EffectRun> without_chosen;  ///< the chosen set without each removable effect

  [[nodiscard]] bool within_tolerance() const { return chosen.change() <= tolerance; }
  /// @returns true if no expensive effect of the chosen set can be removed
  [[nodiscard]] bool is_minimal() const;
  /// Returns the work of the selection and of the chosen set, relative to that of the full set.
  [[nodiscard]] double work_ratio() const {
    return (choice.automatic->work + chosen.work) / full.work;
  }
};

struct EffectStudyOptions {
  double tolerance = 0.01;
  int repeats = 7;  ///< number of timed runs of each set, after one warm-up; 0: no times
};

/// Studies the effects of a case.
/// @param document  a case whose analysis has effects; its tolerance overrides that of the options
/// @throws InputError  if the analysis has no effects or the model is invalid.
[[nodiscard]] EffectStudy study_effects(const Document& document,
                                        const EffectStudyOptions& options);

}  // namespace trammel::harness
