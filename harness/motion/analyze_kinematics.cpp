#include <algorithm>

#include "harness/motion/analyses.h"
#include "harness/scene/case_model.h"

namespace trammel::harness {

StepResult analyze_kinematics(const JsonView&, const CaseModel& case_model, std::size_t step,
                              bool draw, Recorder& record) {
  const solver::Pose& pose = case_model.motion[step].pose;
  const solver::ManipulatorGeometry& geometry = case_model.manipulator->geometry;
  const solver::Posture posture = solver::inverse_kinematics(geometry, pose);
  StepResult result;
  result.outcome = posture.outcome;
  if (draw && step == 0) result.drawing = draw_manipulator(geometry, case_model.motion);
  if (!posture.outcome.solved()) return result;
  const solver::Jacobians at = solver::jacobians(geometry, pose, posture);
  const auto holding = solver::holding_torques(at, wrench_on_platform(case_model, pose));
  result.outcome = holding.outcome;
  record.add_each("active_angle_rad", kActiveJoints, posture.active);
  record.add_each("passive_angle_rad", kElbows, posture.passive);
  record.add_each("elbow_sine", kElbows, posture.elbow_sine);
  record.add_each("holding_torque_N_m", kActiveJoints, holding.torque);
  const std::array<std::string, 3> distal = {"B1-C1", "B2-C2", "B3-C3"};
  record.add_each("distal_tension_N", distal, holding.tension);
  const double reach =
      *std::ranges::max_element(geometry.proximal) + *std::ranges::max_element(geometry.distal);
  result.evidence.add(solver::Residual::constraints, posture.closure_error / reach);
  record.add("closure_error_m", posture.closure_error);
  record.add("parallel_singularity_distance", at.parallel_distance);
  record.add("serial_singularity_distance", at.serial_distance);
  return result;
}

}  // namespace trammel::harness
