#include "harness/analysis/analysis.h"

#include "harness/analysis/analysis_kinds.h"
#include "harness/input/json_view.h"

namespace trammel::harness {
namespace {

StepResult analyse_step(const std::string& kind, const JsonView& analysis,
                        const CaseModel& case_model, std::size_t step, bool draw,
                        Recorder& record) {
  if (kind == "modes") return analyse_modes(analysis, case_model, step, draw, record);
  if (kind == "statics") return analyse_statics(case_model, step, draw, record);
  if (kind == "buckling") return analyse_buckling(analysis, case_model, step, draw, record);
  if (kind == "large-statics")
    return analyse_large_statics(analysis, case_model, step, draw, record);
  if (kind == "harmonic") return analyse_harmonic(analysis, case_model, step, draw, record);
  if (kind == "transient") return analyse_transient(analysis, case_model, step, draw, record);
  if (kind == "kinematics") return analyse_kinematics(case_model, step, draw, record);
  return analyse_properties(case_model, step, draw, record);
}

/// Step by step along the path; ends where a step has no solution.
StepResult analyse_steps(const std::string& kind, const JsonView& analysis,
                         const CaseModel& case_model, bool draw, Recorder& record) {
  StepResult all;
  for (std::size_t step = 0; step < case_model.steps(); ++step) {
    record_path(case_model, step, record);
    StepResult found = analyse_step(kind, analysis, case_model, step, draw && step == 0, record);
    all.counters += found.counters;
    if (found.drawing) all.drawing = std::move(found.drawing);
    if (found.outcome.solved()) continue;
    all.outcome = at_point(case_model, step, found.outcome);
    break;
  }
  return all;
}

StepResult analyse_case_model(const std::string& kind, const JsonView& analysis,
                              const CaseModel& case_model, bool draw, Recorder& record) {
  if (kind == "inverse-dynamics")
    return analyse_inverse_dynamics(analysis, case_model, draw, record);
  if (kind == "forward-dynamics")
    return analyse_forward_dynamics(analysis, case_model, draw, record);
  if (kind == "large-motion") return analyse_large_motion(analysis, case_model, draw, record);
  if (kind == "grnn") return analyse_grnn(analysis, case_model, draw, record);
  if (kind == "elastodynamics") return analyse_elastodynamics(analysis, case_model, draw, record);
  if (kind == "sensitivity") return analyse_sensitivity(analysis, case_model, draw, record);
  if (kind == "sensitivity-map") return analyse_sensitivity_map(analysis, case_model, record);
  return analyse_steps(kind, analysis, case_model, draw, record);
}

/// What was recorded counts where a solution was found.
AnalysisResult result_of(StepResult found, Recorder& record) {
  AnalysisResult result;
  result.outcome = std::move(found.outcome);
  result.drawing = std::move(found.drawing);
  result.counters = found.counters;
  result.timings = std::move(found.timings);
  if (result.outcome.solved()) result.quantities = record.release();
  return result;
}

}  // namespace

void record_path(const CaseModel& case_model, std::size_t step, Recorder& record) {
  if (!case_model.path) return;
  const solver::TrajectoryPoint& point = case_model.motion[step];
  record.add("time_s", "", point.time);
  record.add("pose_x_m", "", point.pose.x);
  record.add("pose_y_m", "", point.pose.y);
  record.add("pose_phi_rad", "", point.pose.phi);
}

solver::Outcome at_point(const CaseModel& case_model, std::size_t step, solver::Outcome outcome) {
  if (case_model.path) outcome.reason.insert(0, "point " + std::to_string(step) + ": ");
  return outcome;
}

std::string analysis_kind(const Document& document) {
  return document.value().at("analysis").begin().key();
}

AnalysisResult analyse(const Document& document, const References& references,
                       const AnalysisOptions& options) {
  const std::string kind = analysis_kind(document);
  const JsonView place = JsonView(document)["analysis"][kind];
  Recorder record;
  if (kind == "comparison") {
    compare_references(place, references, record);
    return result_of({}, record);
  }
  if (kind == "options") {
    analyse_options(document, references, record);
    return result_of({}, record);
  }
  if (kind == "study") {
    return result_of(analyse_study(document, references, options.drawing, record), record);
  }
  if (kind == "manufactured") {
    return result_of(analyse_manufactured(place, options.drawing, record), record);
  }
  if (kind == "grnn" && place.has("samples")) {
    return result_of(analyse_grnn(place, std::nullopt, options.drawing, record), record);
  }
  CaseModel case_model = read_case_model(document);
  if (kind == "kinematics" && !case_model.manipulator) {
    throw place.error("expected a model with a manipulator");
  }
  try {
    EffectChoice choice = choose_effects(document, case_model);
    case_model.effects = choice.chosen;
    AnalysisResult result =
        result_of(analyse_case_model(kind, place, case_model, options.drawing, record), record);
    result.analysis = kind;
    result.effects = std::move(choice.reasons);
    return result;
  } catch (const solver::ModelError& error) {
    throw model_error(document, error);
  }
}

}  // namespace trammel::harness
