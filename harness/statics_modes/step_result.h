#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/recorder.h"
#include "harness/base/timing.h"
#include "harness/input/json_view.h"
#include "harness/input/reference_library.h"
#include "harness/results/run_results.h"
#include "harness/scene/case_model.h"
#include "harness/scene/drawing.h"
#include "harness/statics_modes/warning.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::harness {

/// What an analysis leaves behind beside the quantities that it records: at one step of the path,
/// along the whole of it, or of a case.
struct StepResult {
  solver::Outcome outcome;
  solver::Counters counters;
  solver::Evidence evidence = {};  ///< residuals that decide whether it counts as solved
  std::optional<Drawing> drawing = std::nullopt;  ///< on the first step, when asked for
  std::vector<Warning> warnings = {};
  std::vector<EvaluationTime> timings = {};
  std::optional<results::ModelProbabilities> model_probabilities = std::nullopt;
};

/// Signatures of an analysis: at one step of the scene's path, along all of it, and of a case
/// without a scene.
using AnalyseStep = StepResult(const JsonView& analysis, const CaseModel& case_model,
                               std::size_t step, bool draw, Recorder& record);
using AnalysePath = StepResult(const JsonView& analysis, const CaseModel& case_model, bool draw,
                               Recorder& record);
using AnalyseCase = StepResult(const Document& document, const References& references, bool draw,
                               Recorder& record);

/// Step by step along the path; ends where a step has no solution.
[[nodiscard]] StepResult analyse_steps(
    const CaseModel& case_model, bool draw,
    const std::function<StepResult(std::size_t step, bool draw)>& analyse_step);

inline constexpr solver::Index kMaxDrawnShapes = 12;

/// "mode 3, 12.5 Hz"
/// @param number  what the mode belongs to, as its unit says
[[nodiscard]] std::string mode_label(solver::Index mode, double number, const char* unit);

/// Records frequencies and growth rates of modes about a state; of several states with the mode.
/// @param roundoff  relative, of each frequency; empty where it is not known
void record_frequencies(const Eigen::VectorXd& frequency, const Eigen::VectorXd& growth_rate,
                        bool several, Recorder& record, const Eigen::VectorXd& roundoff = {});

/// The outcome of a step, its reason naming the point of the path.
[[nodiscard]] solver::Outcome outcome_at_path_point(const CaseModel& case_model, std::size_t step,
                                                    solver::Outcome outcome);

}  // namespace trammel::harness
