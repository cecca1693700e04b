#pragma once

#include <string>
#include <variant>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

/// Registry of every analysis with its names, functions, requirements and effects.
namespace trammel::harness {

struct AnalysisKind {
  const char* name;  ///< key below "analysis"
  std::variant<std::monostate, AnalyseStep*, AnalysePath*> of_scene = {};
  bool needs_manipulator = false;
  const EffectRules* effects = nullptr;  ///< null: the analysis does not support effects
  /// Used if `of_scene` is empty or the case has no "model".
  AnalyseCase* of_case = nullptr;
  const char* without_model = "";  ///< description of the model in that case
  /// Residuals that a solution must have before it counts as solved. Empty if the analysis solves
  /// no equation.
  std::vector<solver::Residual> evidence = {};
  /// Warns if a path crosses a parallel singularity between two of its points.
  bool warns_of_crossing = false;
  /// True if the analysis determines the times of its results, so that these are not the times of
  /// the points of the path.
  bool has_own_times = false;

  [[nodiscard]] bool needs_model(const Document& document) const;
};

[[nodiscard]] const std::vector<AnalysisKind>& analysis_kinds();

/// Returns the analysis with that name.
/// @throws std::out_of_range  for a name that the schema does not have.
[[nodiscard]] const AnalysisKind& find_analysis(const std::string& name);

/// Returns the names in one phrase: "statics, modes or elastodynamics".
[[nodiscard]] std::string analyses_with_effects();

}  // namespace trammel::harness
