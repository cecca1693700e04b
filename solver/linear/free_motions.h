#pragma once

#include <Eigen/Core>
#include <string>

#include "solver/linalg/factorization.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

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

/// "free motion: node B along x 1, rotation of node A -0.5"; several are separated by semicolons.
/// Empty without modes. Each names its three largest entries, rotations times the model's size,
/// relative to the largest; the motions are those of the basis in echelon form, which have few.
[[nodiscard]] std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes);

/// Singular with the free motions in words, if there are any.
/// @param K  the factored stiffness
[[nodiscard]] Outcome require_held(const System& system, const Factorization& K,
                                   Counters& counters);

}  // namespace trammel::solver
