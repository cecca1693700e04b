#include "solver/large_motion/solve/rigid_member_velocities.h"

#include <cmath>

#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                             const Eigen::MatrixX3d& node, const VectorXd& member) {
  // Of each coordinate the value that is set last. A map would take a noticeable part of the time
  // of motions with damping, which request these velocities in every iteration.
  VectorXd values = VectorXd::Constant(system.coordinates(), kNaN);
  const auto set = [&](Index k, double value) {
    if (k >= 0 && k < values.size()) values[k] = value;
  };
  for (const MemberElement& element : system.layout().elements) {
    const Member& moved = system.model().members[to_size(element.member)];
    const Vector2d& from = system.model().nodes[to_size(moved.nodes[0])].position;
    const Vector2d along = system.model().nodes[to_size(moved.nodes[1])].position - from;
    for (std::size_t a = 0; a < element.nodes(); ++a) {
      const Index* coordinate = &element.coordinates[element.stride() * a];
      const double s = (element.position(a) - from).dot(along) / along.squaredNorm();
      for (Index k = 0; k < 2; ++k)
        set(coordinate[k], (1 - s) * node(moved.nodes[0], k) + s * node(moved.nodes[1], k));
      if (!element.is_bar()) set(coordinate[2], member[element.member]);
    }
  }
  for (Index i = 0; i < node.rows(); ++i) {
    for (Index k = 0; k < 3; ++k) set(system.layout().node[to_size(i)][to_size(k)], node(i, k));
  }
  PrescribedVelocities given;
  for (Index k = 0; k < values.size(); ++k)
    if (!std::isnan(values[k])) given.emplace_back(k, values[k]);
  return given;
}

}  // namespace trammel::solver::large_motion
