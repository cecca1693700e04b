#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_changes.h"
#include "harness/input/document.h"

/// Measures what effects do: the whole scene, and the scene without some of them.
namespace trammel::harness {

/// The scene with some effects.
struct EffectRun {
  solver::Effects effects;
  solver::Outcome outcome;
  Quantities quantities;
  solver::Counters counters;
  Changes changes;        ///< from the whole scene
  double cpu_s = 0;       ///< median of the repeats; without, of one run
  double cpu_spread = 0;  ///< half of the range between the quartiles, relative
};

struct Ablation {
  std::vector<solver::Effect> effects;  ///< left out with what they carry
  EffectRun run;
};

struct EffectStudy {
  EffectScope scope;
  EffectChoice choice;
  double tolerance = 0;
  EffectRun full, chosen;
  /// Of statics, by linear buckling at the first pose; empty where the loads compress nothing.
  std::optional<double> load_over_buckling_load = {};
  double choice_cpu_s = 0;               ///< what "auto" took to decide
  std::vector<Ablation> singles, pairs;  ///< from the whole scene
  std::vector<Ablation> from_chosen;     ///< each chosen effect left out of the chosen set

  [[nodiscard]] bool within_tolerance() const;  ///< the chosen set is within the tolerance
  /// What the analysis does not have is worth more than the tolerance.
  [[nodiscard]] bool is_beyond_tier() const { return choice.beyond_tier.value_or(0) > tolerance; }
  [[nodiscard]] bool is_minimal() const;  ///< no chosen effect can go
};

struct EffectStudyOptions {
  double tolerance = 0.01;
  bool pairs = true;  ///< also leave out each effect, and each two, of the whole scene
  int repeats = 7;    ///< of each, in turns, after one for warming up; 0: not timed
};

/// @param document  a case whose analysis knows effects; its own "effects" set the tolerance where
///                  they are automatic, and are laid aside
/// @throws InputError  where the scene has no solution with all its effects.
[[nodiscard]] EffectStudy study_effects(const Document& document,
                                        const EffectStudyOptions& options);

}  // namespace trammel::harness
