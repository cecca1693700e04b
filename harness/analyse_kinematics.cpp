#include "harness/analysis_kinds.h"

namespace trammel {
namespace {

/// Loads on the platform's points as one wrench at P; others act on links and do not count.
Vector3d wrench_on_platform(const Scene& scene, const Posture& posture, const Pose& pose) {
  constexpr Index first_C = 6, P = 9;  // nodes A1..A3, B1..B3, C1..C3, P of the builder
  Vector3d wrench = Vector3d::Zero();
  for (const NodalLoad& load : scene.parts.loads) {
    if (load.node < first_C || load.node > P) continue;
    wrench += load.force;
    if (load.node == P) continue;
    const Vector2d arm =
        posture.C[static_cast<std::size_t>(load.node - first_C)] - Vector2d(pose.x, pose.y);
    wrench.z() += arm.x() * load.force.y() - arm.y() * load.force.x();
  }
  return wrench;
}

}  // namespace

StepResult analyse_kinematics(const Scene& scene, std::size_t step, bool draw, Recorder& record) {
  const Pose& pose = scene.poses[step];
  const ManipulatorGeometry& geometry = scene.manipulator->geometry;
  const Posture posture = inverse_kinematics(geometry, pose);
  StepResult result;
  result.outcome = posture.outcome;
  if (draw) result.drawing = draw_manipulator(geometry, scene.poses);
  if (!posture.outcome.solved()) return result;
  const Jacobians at = jacobians(geometry, pose, posture);
  const HoldingTorques holding = holding_torques(at, wrench_on_platform(scene, posture, pose));
  result.outcome = holding.outcome;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string limb = std::to_string(i + 1);
    record.add("active_angle_rad", "A" + limb, posture.active[i]);
    record.add("passive_angle_rad", "B" + limb, posture.passive[i]);
    record.add("elbow_sine", "B" + limb, posture.elbow_sine[i]);
    record.add("holding_torque_N_m", "A" + limb, holding.torque[static_cast<Index>(i)]);
    record.add("distal_tension_N", "B" + limb + "-C" + limb,
               holding.tension[static_cast<Index>(i)]);
  }
  record.add("closure_error_m", "", posture.closure_error);
  record.add("parallel_distance", "", at.parallel_distance);
  record.add("serial_distance", "", at.serial_distance);
  return result;
}

}  // namespace trammel
