#pragma once

#include <string>

#include "harness/analysis/case_effects.h"
#include "harness/statics_modes/step_result.h"

/// Runs one computation: maps a case with its patches to numbers.
namespace trammel::harness {

/// Optional outputs in addition to the numbers.
struct AnalysisOptions {
  bool drawing = true;  ///< nodes, members and shapes, for the report
};

struct AnalysisResult : StepResult {
  Quantities quantities;
  std::vector<results::EffectRow> effects;  ///< effects of the computation and their reasons
};

/// Runs the analysis of a case.
/// @throws InputError  if the model is invalid.
[[nodiscard]] AnalysisResult analyze(const Document& document, const References& references,
                                     const AnalysisOptions& options);

/// Returns the counters with their names, as results store them.
[[nodiscard]] results::Counters named_counters(const solver::Counters& counters);

/// Returns the only key of "analysis": "modes", "statics", ...
[[nodiscard]] std::string analysis_kind(const Document& document);

/// Sets the rounding mode (of <cfenv>) of the solver in this process and in processes that it
/// forks. Reading, checking and printing continue to round to nearest.
void set_solver_rounding(int mode);

/// Adds a warning if det J_x changes its sign between two points of a manipulator's path that are
/// themselves far from any singularity.
void warn_of_crossed_singularity(const CaseModel& case_model, std::vector<Warning>& warnings);

}  // namespace trammel::harness
