#include "solver/assembly/inertia.h"

#include "solver/assembly/strain.h"

namespace trammel::solver {

Eigen::VectorXd inertia_forces(const System& system, const Eigen::VectorXd& a) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(a.size());
  for_each_inertia(system, [&](const auto& coordinates, const auto& m) {
    const auto local = (m * detail::gather(coordinates, a)).eval();
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (coordinates[i] >= 0) force[coordinates[i]] += local[static_cast<Index>(i)];
    }
  });
  return force;
}

}  // namespace trammel::solver
