#include "harness/statics_modes/step_result.h"

#include <fmt/format.h>

namespace trammel::harness {

std::string mode_label(solver::Index mode, double number, const char* unit) {
  return fmt::format("mode {}, {:.4g} {}", mode + 1, number, unit);
}

StepResult analyse_steps(StepAnalysis analyse_step, const JsonView& analysis,
                         const CaseModel& case_model, bool draw, Recorder& record) {
  StepResult all;
  for (std::size_t step = 0; step < case_model.steps(); ++step) {
    record_path(case_model, step, record);
    StepResult found = analyse_step(analysis, case_model, step, draw && step == 0, record);
    all.counters += found.counters;
    all.evidence.add(found.evidence);
    add_warnings(all.warnings, found.warnings);
    if (found.drawing) all.drawing = std::move(found.drawing);
    if (found.outcome.solved()) continue;
    all.outcome = outcome_at_path_point(case_model, step, found.outcome);
    break;
  }
  return all;
}

void record_path(const CaseModel& case_model, std::size_t step, Recorder& record) {
  if (!case_model.path) return;
  const solver::TrajectoryPoint& point = case_model.motion[step];
  record.add("time_s", "", point.time);
  record.add("pose_x_m", "", point.pose.x);
  record.add("pose_y_m", "", point.pose.y);
  record.add("pose_phi_rad", "", point.pose.phi);
}

solver::Outcome outcome_at_path_point(const CaseModel& case_model, std::size_t step,
                                      solver::Outcome outcome) {
  if (case_model.path) outcome.reason.insert(0, "point " + std::to_string(step) + ": ");
  return outcome;
}

}  // namespace trammel::harness
