#include "harness/statics_modes/step_result.h"

#include <fmt/format.h>

#include <algorithm>

namespace trammel::harness {

std::string mode_label(solver::Index mode, double number, const char* unit) {
  return fmt::format("mode {}, {:.4g} {}", mode + 1, number, unit);
}

void record_frequencies(const Eigen::VectorXd& frequency, const Eigen::VectorXd& growth_rate,
                        bool several_states, Recorder& record, const Eigen::VectorXd& roundoff) {
  for (solver::Index i = 0; i < frequency.size(); ++i) {
    const std::string item = several_states ? std::to_string(i + 1) : "";
    record.add("frequency_Hz", item, frequency[i], roundoff.size() > 0 ? roundoff[i] : -1);
    record.add("growth_rate_per_s", item, growth_rate[i]);
  }
}

namespace {

/// Keeps the drawing of the first point of a path, and adds the drawings of later points as poses.
void add_pose_drawing(const CaseModel& case_model, std::size_t step, Drawing found,
                      std::optional<Drawing>& all) {
  if (!all) all = std::move(found);
  const std::vector<results::Shape>& shapes = step == 0 ? all->shapes : found.shapes;
  const std::vector<results::Point>& nodes = step == 0 ? all->nodes : found.nodes;
  if (!case_model.path || shapes.size() != 1 || nodes.size() != all->nodes.size()) return;
  if (shapes.front().label.starts_with("mode ")) return;
  const double time = case_model.motion[step].time;
  all->poses.push_back({time_label(time), nodes, time, shapes.front().displacement});
}

}  // namespace

StepResult analyze_path_points(
    const CaseModel& case_model, bool draw,
    const std::function<StepResult(std::size_t step, bool draw)>& analyze_step) {
  StepResult all;
  const std::size_t stride = std::max<std::size_t>(case_model.path_point_count() / 24, 1);
  for (std::size_t step = 0; step < case_model.path_point_count(); ++step) {
    StepResult found = analyze_step(step, draw && step % stride == 0);
    all.counters += found.counters;
    all.evidence.add(found.evidence);
    add_warnings(all.warnings, found.warnings);
    if (found.drawing) add_pose_drawing(case_model, step, std::move(*found.drawing), all.drawing);
    if (found.outcome.solved()) continue;
    all.outcome = outcome_at_path_point(case_model, step, found.outcome);
    break;
  }
  return all;
}

solver::Outcome outcome_at_path_point(const CaseModel& case_model, std::size_t step,
                                      solver::Outcome outcome) {
  if (case_model.path) outcome.reason.insert(0, "point " + std::to_string(step) + ": ");
  return outcome;
}

}  // namespace trammel::harness
