#pragma once

#include <Eigen/Core>

#include "solver/assembly/element_mass.h"

/// What has mass, on the unconstrained coordinates u, without an assembled mass matrix.
namespace trammel::solver {

/// Mass matrix of a point mass on (x, y, rotation) of its node; the inertia is about its own
/// centre, which sits at `offset` from the node [m, world axes].
template <Real T>
[[nodiscard]] Eigen::Matrix3<T> point_inertia(const T& mass, const T& inertia,
                                              const Vector2d& offset) {
  Eigen::Matrix3<T> m = Eigen::Matrix3<T>::Zero();
  m(0, 0) = m(1, 1) = mass;
  m(0, 2) = m(2, 0) = -mass * offset.y();
  m(1, 2) = m(2, 1) = mass * offset.x();
  m(2, 2) = mass * offset.squaredNorm() + inertia;
  return m;
}

/// Calls visit(coordinates, m) for every frame element, triangle, point mass and member end with
/// inertia: coordinates (array of n indices into u, -1 for none) and m (n x n), world axes.
template <class Visit>
void for_each_inertia(const System& system, Visit&& visit) {
  for (const FrameElement& e : system.mesh.frame) {
    if (e.section.mass_per_length == 0 && e.section.inertia_per_length == 0) continue;
    const Member& member = system.model.members[static_cast<std::size_t>(e.member)];
    visit(e.coordinates, world_mass(e, member));
  }
  for_each_plate_mass(system, visit);
  for (const PointMass& point_mass : system.model.masses) {
    visit(system.coordinates.node[static_cast<std::size_t>(point_mass.node)],
          point_inertia(point_mass.mass, point_mass.inertia, point_mass.offset));
  }
  for (std::size_t i = 0; i < system.model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = system.model.members[i].ends[end].inertia;
      if (inertia == 0) continue;
      visit(std::array<Index, 1>{system.coordinates.member_end[i][end]},
            Eigen::Matrix<double, 1, 1>(inertia));
    }
  }
}

/// M a on the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd inertia_forces(const System& system, const Eigen::VectorXd& a);

}  // namespace trammel::solver
