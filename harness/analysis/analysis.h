#pragma once

#include <string>

#include "harness/analysis/case_effects.h"
#include "harness/statics_modes/step_result.h"

/// One computation: a case with its patches in, numbers out.
namespace trammel::harness {

/// What to keep beside the numbers.
struct AnalysisOptions {
  bool drawing = true;  ///< nodes, members and shapes, for the report
};

struct AnalysisResult : StepResult {
  Quantities quantities;
  std::vector<results::EffectRow> effects;  ///< of the computation
};

/// @throws InputError  where the model has no meaning.
[[nodiscard]] AnalysisResult analyse(const Document& document, const References& references,
                                     const AnalysisOptions& options);

/// Counters with their names, as results store them.
[[nodiscard]] results::Counters named_counters(const solver::Counters& counters);

/// The one key of "analysis": "modes", "statics", ...
[[nodiscard]] std::string analysis_kind(const Document& document);

/// How the solver rounds in this process from now on, and in those it forks: a mode of <cfenv>.
/// Reading, judging and printing go on rounding to the nearest.
void set_solver_rounding(int mode);

/// Adds a warning if J_x changes its sign between two points of a manipulator's path, although each
/// of them is far from any singularity.
void warn_of_crossed_singularity(const CaseModel& case_model, std::vector<Warning>& warnings);

}  // namespace trammel::harness
