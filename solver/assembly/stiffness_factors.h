#pragma once

#include "solver/assembly/system.h"
#include "solver/linalg/augmented_system.h"

namespace trammel::solver {

/// K of the free coordinates in factors: B T and C of all elements (strain.h), without the rows
/// that have no rigidity.
[[nodiscard]] StiffnessFactors stiffness_factors(const System& system);

}  // namespace trammel::solver
