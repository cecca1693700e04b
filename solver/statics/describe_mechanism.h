#pragma once

#include <string>

#include "solver/model/outcome.h"
#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {

/// "free motion: node B along x 1, rotation of node A -0.5"; several are separated by semicolons.
/// Empty without modes. Each names its three largest entries, rotations times the model's size,
/// relative to the largest; the motions are those of the basis in echelon form, which have few.
[[nodiscard]] std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes);

/// Singular with the free motions in words, if there are any.
/// @param K  the factored stiffness
[[nodiscard]] Outcome require_held(const System& system, const Factorization& K,
                                   Counters& counters);

}  // namespace trammel::solver
