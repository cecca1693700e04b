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

/// Result of an analysis, apart from the recorded quantities. The analysis is performed at one
/// point of the path, along the full path, or for a case without a path.
struct StepResult {
  solver::Outcome outcome;
  solver::Counters counters;
  solver::Evidence evidence = {};  ///< residuals that decide if the result counts as solved
  /// Drawing at the first point of the path, if requested.
  std::optional<Drawing> drawing = std::nullopt;
  std::vector<Warning> warnings = {};
  std::vector<EvaluationTime> timings = {};
  std::optional<results::ModelProbabilities> model_probabilities = std::nullopt;
};

/// Types of the functions that perform an analysis: at one point of the path, along the full path,
/// and for a case without a model.
using AnalyseStep = StepResult(const JsonView& analysis, const CaseModel& case_model,
                               std::size_t step, bool draw, Recorder& record);
using AnalysePath = StepResult(const JsonView& analysis, const CaseModel& case_model, bool draw,
                               Recorder& record);
using AnalyseCase = StepResult(const Document& document, const References& references, bool draw,
                               Recorder& record);

/// Runs an analysis at each point of the path in order. Stops at the first point without a
/// solution.
[[nodiscard]] StepResult analyze_path_points(
    const CaseModel& case_model, bool draw,
    const std::function<StepResult(std::size_t step, bool draw)>& analyze_step);

inline constexpr solver::Index kMaxDrawnShapes = 12;

/// Returns the label of a mode: "mode 3, 12.5 Hz".
/// @param number  frequency or load factor of the mode, in the unit `unit`
[[nodiscard]] std::string mode_label(solver::Index mode, double number, const char* unit);

/// Records frequencies and growth rates of the vibration about an equilibrium. If there are several
/// equilibria, there is one quantity per mode, whose name includes the number of the mode.
/// @param roundoff  relative round-off error of each frequency; empty if unknown
void record_frequencies(const Eigen::VectorXd& frequency, const Eigen::VectorXd& growth_rate,
                        bool several_states, Recorder& record,
                        const Eigen::VectorXd& roundoff = {});

/// Returns the outcome of one point of the path, with the number of the point in its reason.
[[nodiscard]] solver::Outcome outcome_at_path_point(const CaseModel& case_model, std::size_t step,
                                                    solver::Outcome outcome);

}  // namespace trammel::harness
