#include "harness/scene/tracking.h"

#include <cmath>
#include <numbers>

#include "solver/large_motion/solve/rigid_member_velocities.h"
#include "solver/manipulator/inverse_dynamics.h"

namespace trammel::harness {
namespace {

void require_joints(const JsonView& place, const solver::ManipulatorDesign& design) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (design.active[i].kind != solver::ActiveKind::locked) {
      throw place.error("expected locked actuators: they are driven");
    }
    if (design.elbow[i].kind != solver::ElbowKind::hinged ||
        design.platform_joint[i].kind != solver::PlatformJointKind::hinged) {
      throw place.error("expected hinged elbows and platform joints: others hinder the motion");
    }
  }
}

/// Angle, rate and acceleration of one actuator along the path, from where it starts.
solver::large_motion::TimeFunction actuator(const solver::RigidManipulator& rigid,
                                            const solver::Path& path, std::size_t limb) {
  const auto i = static_cast<solver::Index>(limb);
  const double start = solver::inverse_dynamics(rigid, solver::at(path, 0)).q[i];
  return [rigid, path, i, start](double t) {
    const solver::InverseDynamics motion = solver::inverse_dynamics(rigid, solver::at(path, t));
    return std::array<double, 3>{std::remainder(motion.q[i] - start, 2 * std::numbers::pi),
                                 motion.q_dot[i], motion.q_ddot[i]};
  };
}

solver::Index member_between(const solver::Model& model, solver::Index first,
                             solver::Index second) {
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const std::array<solver::Index, 2>& nodes = model.members[m].nodes;
    if (nodes[0] == first && nodes[1] == second) return static_cast<solver::Index>(m);
  }
  return -1;
}

}  // namespace

void add_tracking_drives(const JsonView& place, const CaseModel& case_model, solver::Model& model,
                         solver::large_motion::LargeMotionModel& large_motion) {
  if (!case_model.manipulator || !case_model.path) {
    throw place.error("expected a manipulator with a trajectory");
  }
  require_joints(place, *case_model.manipulator);
  const solver::Path& path = *case_model.path;
  const solver::RigidManipulator rigid = solver::rigid_manipulator(*case_model.manipulator);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "A" + std::to_string(i + 1);
    const solver::Index node = model.find_node(name);
    for (solver::Support& support : model.supports) {
      if (support.node == node) support.fixed[2] = false;
    }
    large_motion.drives.push_back({name, node, 2, actuator(rigid, path, i)});
  }
}

solver::large_motion::PrescribedVelocities tracking_start(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system) {
  const solver::Model& model = system.model();
  const solver::TrajectoryPoint start = solver::at(*case_model.path, 0);
  const solver::InverseDynamics motion =
      solver::inverse_dynamics(solver::rigid_manipulator(*case_model.manipulator), start);
  const auto turn = [](double rate, const Eigen::Vector2d& arm) {
    return Eigen::Vector2d(-rate * arm.y(), rate * arm.x());
  };
  Eigen::MatrixX3d node(static_cast<solver::Index>(model.nodes.size()), 3);
  const Eigen::Vector2d P(start.pose.x, start.pose.y);
  for (solver::Index k = 0; k < node.rows(); ++k) {
    // The platform's nodes; those of the limbs follow below.
    const Eigen::Vector2d& place = model.nodes[static_cast<std::size_t>(k)].position;
    node.row(k) << (start.velocity.head<2>() + turn(start.velocity[2], place - P)).transpose(),
        start.velocity[2];
  }
  Eigen::VectorXd member = Eigen::VectorXd::Zero(static_cast<solver::Index>(model.members.size()));
  for (solver::Index i = 0; i < 3; ++i) {
    const std::string limb = std::to_string(i + 1);
    const solver::Index a = model.find_node("A" + limb), b = model.find_node("B" + limb);
    const Eigen::Vector2d arm = model.nodes[static_cast<std::size_t>(b)].position -
                                model.nodes[static_cast<std::size_t>(a)].position;
    node.row(a) << 0, 0, motion.q_dot[i];
    node.row(b) << turn(motion.q_dot[i], arm).transpose(), motion.q_dot[i];
    member[member_between(model, a, b)] = motion.q_dot[i];
    member[member_between(model, b, model.find_node("C" + limb))] = motion.q_dot[3 + i];
  }
  return rigid_member_velocities(system, node, member);
}

}  // namespace trammel::harness
