#pragma once

#include <string>
#include <variant>
#include <vector>

#include "harness/analysis/effect_rules.h"
#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

/// Table of all analyses with their names, functions, requirements and selectable physical effects.
namespace trammel::harness {

struct AnalysisKind {
  const char* name;  ///< key of the case below "analysis"
  std::variant<std::monostate, AnalyseStep*, AnalysePath*> of_scene = {};
  bool needs_manipulator = false;
  /// Rules for selecting physical effects; null: none can be selected.
  const EffectRules* effects = nullptr;
  /// Function that performs the analysis if `of_scene` is empty or the case has no key "model".
  AnalyseCase* of_case = nullptr;
  const char* without_model = "";  ///< description of the model if `of_case` is used
  /// Residuals that must be small for the status "solved"; empty if no equation is solved.
  std::vector<solver::Residual> evidence = {};
  /// True if the analysis warns of paths that cross a parallel singularity between two points.
  bool warns_of_crossing = false;
  /// True if the analysis determines the times of its results. If false, the results belong to the
  /// times of the points of the path.
  bool has_own_times = false;

  [[nodiscard]] bool needs_model(const Document& document) const;
};

[[nodiscard]] const std::vector<AnalysisKind>& analysis_kinds();

/// Returns the analysis with the name `name`.
/// @throws std::out_of_range  for an unknown name, which the schema of cases excludes.
[[nodiscard]] const AnalysisKind& find_analysis(const std::string& name);

/// Returns the names of all analyses with selectable effects: "statics, modes or elastodynamics".
[[nodiscard]] std::string analyses_with_effects();

}  // namespace trammel::harness
