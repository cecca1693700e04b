#include "harness/statics_modes/step_result.h"

#include <fmt/format.h>

#include <algorithm>

namespace trammel::harness {

std::string mode_label(solver::Index mode, double number, const char* unit) {
  return fmt::format("mode {}, {:.4g} {}", mode + 1, number, unit);
}

namespace {

/// The first drawing stays, and holds those of later points of the path as moments.
void add_moment(const CaseModel& case_model, std::size_t step, Drawing found,
                std::optional<Drawing>& all) {
  if (!all) all = std::move(found);
  const std::vector<results::Shape>& shapes = step == 0 ? all->shapes : found.shapes;
  const std::vector<results::Point>& nodes = step == 0 ? all->nodes : found.nodes;
  if (!case_model.path || shapes.size() != 1 || nodes.size() != all->nodes.size()) return;
  if (shapes.front().label.starts_with("mode ")) return;
  const double time = case_model.motion[step].time;
  all->poses.push_back({moment_label(time), nodes, time, shapes.front().displacement});
}

}  // namespace

StepResult analyse_steps(StepAnalysis analyse_step, const JsonView& analysis,
                         const CaseModel& case_model, bool draw, Recorder& record) {
  StepResult all;
  const std::size_t stride = std::max<std::size_t>(case_model.steps() / 24, 1);
  for (std::size_t step = 0; step < case_model.steps(); ++step) {
    record_path(case_model, step, record);
    const bool drawn = draw && step % stride == 0;
    StepResult found = analyse_step(analysis, case_model, step, drawn, record);
    all.counters += found.counters;
    all.evidence.add(found.evidence);
    add_warnings(all.warnings, found.warnings);
    if (found.drawing) add_moment(case_model, step, std::move(*found.drawing), all.drawing);
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
