#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"
#include "solver/linalg/factorization.h"

namespace trammel::solver {

/// Motions of the free coordinates that deform nothing: the null space of K.
struct ZeroEnergyModes {
  Eigen::MatrixXd basis;  ///< q x count
  bool all_found = true;  ///< false: there are more than were looked for
  [[nodiscard]] Eigen::Index count() const { return basis.cols(); }
};

/// Looks for free motions where the factored K gives cause for it (a small, zero or negative
/// pivot), by inverse iteration with a slight shift. Whether a motion is free is judged by the
/// elements' deformations (u^T K u against its own rounding), not by the size of a pivot: a long
/// slender chain is ill-conditioned, but it is not a mechanism.
[[nodiscard]] ZeroEnergyModes find_zero_energy_modes(const System& system, const Factorization& K,
                                                     Counters& counters);

}  // namespace trammel::solver
