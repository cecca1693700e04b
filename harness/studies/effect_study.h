#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_changes.h"
#include "harness/input/document.h"

/// Measures physical effects, such as rotary inertia: compares the results of a case (scene) with
/// all effects, with the selected effects, and without each effect.
namespace trammel::harness {

/// Results of the studied case (scene) with one set of physical effects.
struct EffectRun {
  solver::Effects effects, left_out;
  solver::Outcome outcome;
  Quantities quantities;
  solver::Counters counters;
  double work = 0;   ///< counted work, see `estimated_work` in coarse_scene.h
  Changes changes;   ///< changes of the results, relative to the results with all effects
  double cpu_s = 0;  ///< median of the repeats; `without_chosen`: time of a single run

  /// Returns the largest relative change of the results, compared with all effects; infinite if the
  /// computation has no solution.
  [[nodiscard]] double largest_change() const { return max_change(changes).value; }
};

struct EffectStudy {
  EffectScope scope;
  EffectChoice choice;
  double tolerance = 0;
  EffectRun full, chosen;
  /// Relative change of the results with the chosen effects if the number of elements is halved.
  /// The change exceeds the discretization error of the unchanged mesh. It is empty if no member
  /// has two elements.
  std::optional<double> mesh_change;
  double deciding_cpu_s = 0;
  /// Runs with all effects except one, for each effect. They measure the separate contributions of
  /// the effects.
  std::vector<EffectRun> without_one;
  /// Runs without one of the chosen effects, for each chosen effect that can be removed.
  std::vector<EffectRun> without_chosen;

  [[nodiscard]] bool within_tolerance() const { return chosen.largest_change() <= tolerance; }
  /// @returns true if no expensive effect can be removed from the chosen effects within the
  ///   tolerance
  [[nodiscard]] bool is_minimal() const;
  /// Returns the counted work of the selection and of the run with the chosen effects, relative to
  /// the work of the run with all effects.
  [[nodiscard]] double work_ratio() const {
    return (choice.automatic->work + chosen.work) / full.work;
  }
};

struct EffectStudyOptions {
  double tolerance = 0.01;
  int repeats = 7;  ///< repeated runs for the times; 0: each time is that of a single run
  bool measures_contributions = true;  ///< false: `EffectStudy::without_one` remains empty
};

/// Measures by how much each physical effect changes the results and the computing time of a case.
/// @param document  a case whose analysis has effects; its tolerance overrides that of `options`
/// @throws InputError  if the analysis has no effects or the model is invalid.
[[nodiscard]] EffectStudy study_effects(const Document& document,
                                        const EffectStudyOptions& options);

}  // namespace trammel::harness
