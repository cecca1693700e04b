#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/base/recorder.h"
#include "harness/base/timing.h"
#include "harness/base/warning.h"
#include "harness/input/json_view.h"
#include "harness/results/run_results.h"
#include "harness/scene/case_model.h"
#include "harness/scene/drawing.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::harness {

/// What an analysis leaves behind beside the quantities that it records: at one step of the path,
/// along the whole of it, or of a case.
struct StepResult {
  solver::Outcome outcome;
  solver::Counters counters;
  std::optional<Drawing> drawing;  ///< on the first step, when asked for
  std::vector<EvaluationTime> timings = {};
  solver::Evidence evidence = {};  ///< residuals that decide whether it counts as solved
  std::vector<Warning> warnings = {};
  std::optional<results::ModelProbabilities> model_probabilities = std::nullopt;
};

/// At one step of the scene's path.
using StepAnalysis = StepResult (*)(const JsonView& analysis, const CaseModel& case_model,
                                    std::size_t step, bool draw, Recorder& record);

/// Step by step along the path; ends where a step has no solution.
[[nodiscard]] StepResult analyse_steps(StepAnalysis analyse_step, const JsonView& analysis,
                                       const CaseModel& case_model, bool draw, Recorder& record);

inline constexpr solver::Index kMaxDrawnShapes = 12;

/// "mode 3, 12.5 Hz"
/// @param number  what the mode belongs to, as its unit says
[[nodiscard]] std::string mode_label(solver::Index mode, double number, const char* unit);

/// Time and pose of a step of the path; nothing where there is none.
void record_path(const CaseModel& case_model, std::size_t step, Recorder& record);

/// The outcome of a step, its reason naming the point of the path.
[[nodiscard]] solver::Outcome outcome_at_path_point(const CaseModel& case_model, std::size_t step,
                                                    solver::Outcome outcome);

}  // namespace trammel::harness
