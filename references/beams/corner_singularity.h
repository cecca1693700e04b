#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// The corner of a plate between a clamped and a free side, where displacements grow like r^l:
///   sin^2(l w) = (1 + k)^2/(4 k) - l^2 sin^2(w)/k
/// with the angle w between the sides and k = (3 - nu)/(1 + nu) in plane stress, 3 - 4 nu in plane
/// strain (M. L. Williams, Stress singularities resulting from various boundary conditions in
/// angular corners of plates in extension, J. Appl. Mech. 19, 1952). On even meshes energies,
/// displacements and frequencies converge with h^(2 l) where the elements would do better.
namespace trammel::references {

/// Arguments: clamped_side, free_side (directions [x, y] from the corner), nu,
/// plane (stress by default, or strain). Value: the smallest l, where it is real.
[[nodiscard]] std::vector<double> wedge_exponent_program(const Json& arguments);

}  // namespace trammel::references
