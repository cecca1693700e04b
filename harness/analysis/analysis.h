#pragma once

#include <string>

#include "harness/analysis/case_effects.h"
#include "harness/statics_modes/step_result.h"

/// Runs the analysis of one case, and returns the computed quantities.
namespace trammel::harness {

/// Optional outputs of an analysis in addition to the computed quantities.
struct AnalysisOptions {
  bool drawing = true;  ///< true: also compute the drawing of the model
};

struct AnalysisResult : StepResult {
  Quantities quantities;
  /// Physical effects, with the reasons for their selection.
  std::vector<results::EffectRow> effects;
};

/// Runs the analysis of a case.
/// @throws InputError  if the model is invalid.
[[nodiscard]] AnalysisResult analyze(const Document& document, const References& references,
                                     const AnalysisOptions& options);

/// Returns the numbers of element evaluations, factorizations, solves and steps, by their names in
/// results.json.
[[nodiscard]] results::Counters named_counters(const solver::Counters& counters);

/// Returns the name of the analysis of a case, the only key of "analysis": "modes", "statics", ...
[[nodiscard]] std::string analysis_kind(const Document& document);

/// Sets the rounding mode (of <cfenv>) of the solver in this process and in processes that it
/// forks. Code outside of the solver, such as checks and output, continues to round to nearest.
void set_solver_rounding_mode(int mode);

/// Adds a warning if the determinant of the parallel Jacobian changes its sign between two points
/// of a manipulator's path. The path then crosses a singularity between these two points, where
/// nothing is computed.
void warn_of_crossed_singularity(const CaseModel& case_model, std::vector<Warning>& warnings);

}  // namespace trammel::harness
