#include "harness/motion/analyse_kinematics.h"

#include <algorithm>

#include "harness/scene/rigid_case_model.h"

namespace trammel::harness {

StepResult analyse_kinematics(const JsonView&, const CaseModel& case_model, std::size_t step,
                              bool draw, Recorder& record) {
  const solver::Pose& pose = case_model.motion[step].pose;
  const solver::ManipulatorGeometry& geometry = case_model.manipulator->geometry;
  const solver::Posture posture = solver::inverse_kinematics(geometry, pose);
  StepResult result;
  result.outcome = posture.outcome;
  if (draw && step == 0) result.drawing = draw_manipulator(geometry, case_model.motion);
  if (!posture.outcome.solved()) return result;
  const solver::Jacobians at = solver::jacobians(geometry, pose, posture);
  const solver::HoldingTorques holding =
      solver::holding_torques(at, wrench_on_platform(case_model, pose));
  result.outcome = holding.outcome;
  static const std::array<std::string, 3> active = {"A1", "A2", "A3"}, elbow = {"B1", "B2", "B3"},
                                          distal = {"B1-C1", "B2-C2", "B3-C3"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<solver::Index>(i);
    record.add("active_angle_rad", active[i], posture.active[i]);
    record.add("passive_angle_rad", elbow[i], posture.passive[i]);
    record.add("elbow_sine", elbow[i], posture.elbow_sine[i]);
    record.add("holding_torque_N_m", active[i], holding.torque[row]);
    record.add("distal_tension_N", distal[i], holding.tension[row]);
  }
  const double reach =
      *std::ranges::max_element(geometry.proximal) + *std::ranges::max_element(geometry.distal);
  result.evidence.add(solver::Residual::constraints, posture.closure_error / reach);
  record.add("closure_error_m", "", posture.closure_error);
  record.add("parallel_singularity_distance", "", at.parallel_distance);
  record.add("serial_singularity_distance", "", at.serial_distance);
  return result;
}

}  // namespace trammel::harness
