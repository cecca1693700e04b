#include "harness/export/mechanism.h"

#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::harness {
namespace {

Json body(double mass, double inertia, const solver::BodyMotion& start) {
  return {{"mass_kg", mass},
          {"inertia_kg_m2", inertia},
          {"center_m", {start.position.x(), start.position.y()}},
          {"angle_rad", start.angle}};
}

Json joint(const std::string& first, const std::string& second, const Eigen::Vector2d& at) {
  return {{"bodies", {first, second}}, {"position_m", {at.x(), at.y()}}};
}

Json row(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

Json mechanism_json(const CaseModel& case_model) {
  const solver::RigidManipulator rigid = solver::rigid_manipulator(*case_model.manipulator);
  const solver::TrajectoryPoint& first = case_model.motion.front();
  const solver::InverseDynamics start = solver::inverse_dynamics(rigid, first);
  const solver::Posture posture = solver::inverse_kinematics(rigid.geometry, first.pose);
  Json bodies = Json::object(), joints = Json::object();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i + 1);
    const std::string proximal = "A" + n + "-B" + n, distal = "B" + n + "-C" + n;
    bodies[proximal] = body(rigid.proximal[i].mass, rigid.proximal[i].inertia, start.bodies[i]);
    bodies[distal] = body(rigid.distal[i].mass, rigid.distal[i].inertia, start.bodies[3 + i]);
    joints["A" + n] = joint("ground", proximal, rigid.geometry.base[i]);
    joints["B" + n] = joint(proximal, distal, posture.B[i]);
    joints["C" + n] = joint(distal, "platform", posture.C[i]);
  }
  bodies["platform"] = body(rigid.platform.mass, rigid.platform.inertia, start.bodies[6]);
  Json path = {{"time_s", Json::array()}};
  for (const solver::TrajectoryPoint& point : case_model.motion) {
    path["time_s"].push_back(point.time);
    path["pose_m_rad"].push_back(row({point.pose.x, point.pose.y, point.pose.phi}));
    path["velocity_per_s"].push_back(row(point.velocity));
    path["acceleration_per_s2"].push_back(row(point.acceleration));
  }
  return {{"bodies", bodies}, {"joints", joints}, {"path", path}};
}

}  // namespace trammel::harness
