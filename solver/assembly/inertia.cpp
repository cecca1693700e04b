#include "solver/assembly/inertia.h"

#include "solver/assembly/strain.h"

namespace trammel::solver {

Eigen::VectorXd inertia_forces(const System& system, const Eigen::VectorXd& a) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(a.size());
  for_each_inertia(system, [&](const auto& coordinates, const auto& m) {
    const auto local = (m * detail::gather(coordinates, a)).eval();
    detail::scatter(coordinates, local, force);
  });
  return force;
}

}  // namespace trammel::solver
