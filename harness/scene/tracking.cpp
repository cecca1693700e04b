#include "harness/scene/tracking.h"

#include <cmath>
#include <numbers>

#include "solver/large_motion/solve/rigid_member_velocities.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel {
namespace {

void require_joints(const JsonView& place, const ManipulatorDesign& design) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (design.active[i].kind != ActiveKind::locked) {
      throw place.error("expected locked actuators: they are driven");
    }
    if (design.elbow[i].kind != ElbowKind::hinged ||
        design.platform_joint[i].kind != PlatformJointKind::hinged) {
      throw place.error("expected hinged elbows and platform joints: others hinder the motion");
    }
  }
}

/// Angle, rate and acceleration of one actuator along the path, from where it starts.
large::TimeFunction actuator(const RigidManipulator& rigid, const Path& path, std::size_t limb) {
  const auto i = static_cast<Index>(limb);
  const double start = inverse_dynamics(rigid, at(path, 0)).q[i];
  return [rigid, path, i, start](double t) {
    const InverseDynamics motion = inverse_dynamics(rigid, at(path, t));
    return std::array<double, 3>{std::remainder(motion.q[i] - start, 2 * std::numbers::pi),
                                 motion.q_dot[i], motion.q_ddot[i]};
  };
}

Index member_between(const Model& model, Index first, Index second) {
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const std::array<Index, 2>& nodes = model.members[m].nodes;
    if (nodes[0] == first && nodes[1] == second) return static_cast<Index>(m);
  }
  return -1;
}

}  // namespace

void add_tracking_drives(const JsonView& place, const CaseModel& case_model, Model& model, large::LargeMotionModel& large_motion) {
  if (!case_model.manipulator || !case_model.path) {
    throw place.error("expected a manipulator with a trajectory");
  }
  require_joints(place, *case_model.manipulator);
  const Path& path = *case_model.path;
  const RigidManipulator rigid = rigid_manipulator(*case_model.manipulator);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "A" + std::to_string(i + 1);
    const Index node = model.find_node(name);
    for (Support& support : model.supports) {
      if (support.node == node) support.fixed[2] = false;
    }
    large_motion.drives.push_back({name, node, 2, actuator(rigid, path, i)});
  }
}

large::PrescribedVelocities tracking_start(const CaseModel& case_model, const large::GeometricallyExactSystem& system) {
  const Model& model = system.model();
  const TrajectoryPoint start = at(*case_model.path, 0);
  const InverseDynamics motion = inverse_dynamics(rigid_manipulator(*case_model.manipulator), start);
  const auto turn = [](double rate, const Vector2d& arm) {
    return Vector2d(-rate * arm.y(), rate * arm.x());
  };
  Eigen::MatrixX3d node(static_cast<Index>(model.nodes.size()), 3);
  const Vector2d P(start.pose.x, start.pose.y);
  for (Index k = 0; k < node.rows(); ++k) {
    // The platform's nodes; those of the limbs follow below.
    const Vector2d& place = model.nodes[static_cast<std::size_t>(k)].position;
    node.row(k) << (start.velocity.head<2>() + turn(start.velocity[2], place - P)).transpose(),
        start.velocity[2];
  }
  Eigen::VectorXd member = Eigen::VectorXd::Zero(static_cast<Index>(model.members.size()));
  for (Index i = 0; i < 3; ++i) {
    const std::string limb = std::to_string(i + 1);
    const Index a = model.find_node("A" + limb), b = model.find_node("B" + limb);
    const Vector2d arm = model.nodes[static_cast<std::size_t>(b)].position -
                         model.nodes[static_cast<std::size_t>(a)].position;
    node.row(a) << 0, 0, motion.q_dot[i];
    node.row(b) << turn(motion.q_dot[i], arm).transpose(), motion.q_dot[i];
    member[member_between(model, a, b)] = motion.q_dot[i];
    member[member_between(model, b, model.find_node("C" + limb))] = motion.q_dot[3 + i];
  }
  return rigid_member_velocities(system, node, member);
}

}  // namespace trammel
