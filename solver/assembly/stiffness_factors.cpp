#include "solver/assembly/stiffness_factors.h"

#include <vector>

#include "solver/assembly/strain.h"

namespace trammel::solver {

StiffnessFactors stiffness_factors(const System& system) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> rigidity;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    for (Index i = 0; i < c.size(); ++i) {
      if (c[i] == 0) continue;
      for (std::size_t k = 0; k < coordinates.size(); ++k) {
        const double b = B(i, static_cast<Index>(k));
        if (coordinates[k] >= 0 && b != 0) {
          entries.emplace_back(static_cast<Index>(rigidity.size()), coordinates[k], b);
        }
      }
      rigidity.push_back(c[i]);
    }
  });
  SparseMatrix B(static_cast<Index>(rigidity.size()), system.T.rows());
  B.setFromTriplets(entries.begin(), entries.end());
  return {B * system.T, B.cwiseAbs() * system.T.cwiseAbs(),
          Eigen::Map<const Eigen::VectorXd>(rigidity.data(), B.rows())};
}

}  // namespace trammel::solver
