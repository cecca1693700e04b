#include "solver/elastodynamics/nominal_motion.h"

#include <algorithm>
#include <cmath>

#include "solver/model/plane.h"

namespace trammel::solver {

Vector2d PartMotion::derivative(const Vector2d& at_start, int order) const {
  const Vector2d now = rotated(at_start, angle);
  if (order == 0) return now;
  if (order == 1) return rate * perpendicular(now);
  return acceleration * perpendicular(now) - rate * rate * now;
}

NominalMotion nominal_motion(const Model& model, const InverseDynamics& dynamics,
                             const Vector9d& from, const TrajectoryPoint& point,
                             const Vector2d& gravity) {
  const auto part = [&](Index i) {
    return PartMotion{dynamics.q[i] - from[i], dynamics.q_dot[i], dynamics.q_ddot[i]};
  };
  NominalMotion motion;
  motion.gravity = gravity;
  for (Index limb = 0; limb < 3; ++limb) {
    motion.part.push_back(part(limb));
    motion.part.push_back(part(3 + limb));
  }
  motion.part.resize(to_size(body_part(model, std::ssize(model.rigid_bodies))), part(8));
  for (Eigen::MatrixX2d& values : motion.node) values.resize(std::ssize(model.nodes), 2);
  using Carrier = std::array<Vector2d, 3>;
  const auto place = [&](Index node, const Vector2d& start, const Carrier& carrier,
                         const PartMotion& turns) {
    const Vector2d arm = model.nodes[to_size(node)].position - start;
    for (int order = 0; order < 3; ++order) {
      motion.node[to_size(order)].row(node) =
          carrier[to_size(order)] + turns.derivative(arm, order);
    }
  };
  for (Index limb = 0; limb < 3; ++limb) {
    const Vector2d& A = model.nodes[to_size(limb)].position;
    for (const Index node : {limb, 3 + limb})
      place(node, A, {A, Vector2d::Zero(), Vector2d::Zero()}, motion.part[to_size(2 * limb)]);
  }
  // C1 C2 C3, P and the nodes of a plate turn with the platform.
  const Carrier P = {point.pose.position(), point.velocity.head<2>(), point.acceleration.head<2>()};
  for (Index node = 6; node < std::ssize(model.nodes); ++node)
    place(node, from.segment<2>(6), P, motion.part.back());
  return motion;
}

double largest_angular_velocity(const NominalMotion& motion) {
  double largest = 0;
  for (const PartMotion& part : motion.part) largest = std::max(largest, std::abs(part.rate));
  return largest;
}

}  // namespace trammel::solver
