#pragma once

#include <string>
#include <variant>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

/// All analyses in one table: what each is called, computes and knows.
namespace trammel::harness {

struct AnalysisKind {
  const char* name;  ///< the key below "analysis"
  std::variant<std::monostate, AnalyseStep*, AnalysePath*> of_scene = {};
  bool needs_manipulator = false;
  const EffectRules* effects = nullptr;  ///< null: knows none
  /// In the place of `of_scene`, where that is empty or the case has no "model".
  AnalyseCase* of_case = nullptr;
  const char* without_model = "";  ///< what stands for the model then, in words
  /// What a result must show before it counts as solved; empty: it solves no equation of its own.
  std::vector<solver::Residual> evidence = {};
  /// Warns if a path crosses a parallel singularity between two of its points.
  bool warns_of_crossing = false;
  /// Has times of its own, not those of the points of the path.
  bool has_own_times = false;

  [[nodiscard]] bool needs_model(const Document& document) const;
};

[[nodiscard]] const std::vector<AnalysisKind>& analysis_kinds();

/// @throws std::out_of_range  for a name that the schema does not have.
[[nodiscard]] const AnalysisKind& find_analysis(const std::string& name);

/// "statics, modes or elastodynamics"
[[nodiscard]] std::string analyses_with_effects();

}  // namespace trammel::harness
