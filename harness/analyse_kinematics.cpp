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
  static const std::array<std::string, 3> active = {"A1", "A2", "A3"}, elbow = {"B1", "B2", "B3"},
                                          distal = {"B1-C1", "B2-C2", "B3-C3"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Index>(i);
    record.add("active_angle_rad", active[i], posture.active[i]);
    record.add("passive_angle_rad", elbow[i], posture.passive[i]);
    record.add("elbow_sine", elbow[i], posture.elbow_sine[i]);
    record.add("holding_torque_N_m", active[i], holding.torque[row]);
    record.add("distal_tension_N", distal[i], holding.tension[row]);
  }
  record.add("closure_error_m", "", posture.closure_error);
  record.add("parallel_distance", "", at.parallel_distance);
  record.add("serial_distance", "", at.serial_distance);
  return result;
}

}  // namespace trammel
