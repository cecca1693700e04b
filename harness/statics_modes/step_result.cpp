#include "harness/statics_modes/step_result.h"

#include <fmt/format.h>

namespace trammel::harness {

std::string mode_label(solver::Index mode, double number, const char* unit) {
  return fmt::format("mode {}, {:.4g} {}", mode + 1, number, unit);
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
