#include "solver/large_motion/solve/rigid_member_velocities.h"

#include <map>

#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                             const Eigen::MatrixX3d& node, const VectorXd& member) {
  std::map<Index, double> given;  // of each coordinate the value that is set last
  const auto set = [&](Index k, double value) {
    if (k >= 0 && k < system.coordinates()) given[k] = value;
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
  return {given.begin(), given.end()};
}

}  // namespace trammel::solver::large_motion
