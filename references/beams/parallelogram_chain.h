#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// The chain of N four-bar loops of the IFToMM benchmark A02: 2 N + 1 equal uniform rods of length
/// l, of which N + 1 rotate about fixed pivots and N link them, all parallelograms. Its one
/// coordinate theta from the upper vertical obeys
///   theta'' = a sin theta,  a = (g/l) ((N + 1)/2 + N) / ((N + 1)/3 + N),
/// solved by Jacobi's functions: from theta = 0 with theta' = W, k^2 = 4 a/(W^2 + 4 a) and
/// s = t sqrt(W^2 + 4 a)/2 give sin(theta/2) = k' sd(s, k), cos(theta/2) = cd(s, k).
namespace trammel::references {

/// Arguments: loops (N), length_m, gravity_m_s2, start_speed_m_s (of the rods' upper ends),
/// times_s, output (position | velocity). Values: x, y of the first rod's free end from its pivot
/// [m], or their rates [m/s], for each time.
[[nodiscard]] std::vector<double> parallelogram_chain_program(const Json& arguments);

}  // namespace trammel::references
