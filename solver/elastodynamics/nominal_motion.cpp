#include "solver/elastodynamics/nominal_motion.h"

#include <algorithm>
#include <cmath>

#include "solver/model/plane.h"

namespace trammel::solver {

NominalMotion nominal_motion(const ManipulatorDesign& design, const Model& model,
                             const InverseDynamics& dynamics, const Vector9d& from,
                             const TrajectoryPoint& point, const Vector2d& gravity) {
  const auto part = [&](Index i) {
    return PartMotion{dynamics.q[i] - from[i], dynamics.q_dot[i], dynamics.q_ddot[i]};
  };
  const PartMotion platform = part(8);
  NominalMotion motion;
  motion.gravity = gravity;
  motion.plate.assign(model.plates.size(), platform);
  motion.rigid_body.assign(model.rigid_bodies.size(), platform);
  const auto nodes = static_cast<Index>(model.nodes.size());
  motion.position.resize(nodes, 2);
  motion.velocity.setZero(nodes, 2);
  motion.acceleration.setZero(nodes, 2);
  for (Index i = 0; i < 3; ++i) {
    motion.member.push_back(part(i));
    motion.member.push_back(part(3 + i));
    const Vector2d A = design.geometry.base[static_cast<std::size_t>(i)];
    const double length = design.geometry.proximal[static_cast<std::size_t>(i)];
    const Vector2d arm = length * Vector2d(std::cos(dynamics.q[i]), std::sin(dynamics.q[i]));
    const double rate = dynamics.q_dot[i];
    motion.position.row(i) = A;
    motion.position.row(3 + i) = A + arm;
    motion.velocity.row(3 + i) = rate * perpendicular(arm);
    motion.acceleration.row(3 + i) = dynamics.q_ddot[i] * perpendicular(arm) - rate * rate * arm;
  }
  // C1 C2 C3, P and the nodes of a plate turn with the platform.
  const Vector2d P = from.segment<2>(6);
  const Vector2d now(point.pose.x, point.pose.y);
  for (Index i = 6; i < nodes; ++i) {
    const Vector2d arm =
        rotated(model.nodes[static_cast<std::size_t>(i)].position - P, platform.angle);
    motion.position.row(i) = now + arm;
    motion.velocity.row(i) = point.velocity.head<2>() + platform.rate * perpendicular(arm);
    motion.acceleration.row(i) = point.acceleration.head<2>() +
                                 platform.acceleration * perpendicular(arm) -
                                 platform.rate * platform.rate * arm;
  }
  return motion;
}

double largest_angular_velocity(const NominalMotion& motion) {
  double largest = 0;
  for (const auto* parts : {&motion.member, &motion.plate, &motion.rigid_body}) {
    for (const PartMotion& part : *parts) largest = std::max(largest, std::abs(part.rate));
  }
  return largest;
}

}  // namespace trammel::solver
