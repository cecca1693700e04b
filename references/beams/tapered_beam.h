#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Bending vibration of a clamped-free Euler-Bernoulli beam of rectangular section whose depth and
/// width vary linearly, by Rayleigh and Ritz with s^2 x^k, k = 0 ... 31, where s runs from 0 to 1
/// along the beam and x = 2 s - 1: A is of second and I of fourth degree, so that all integrals are
/// sums of fractions.
namespace trammel::references {

/// Arguments: length_m, E_Pa, rho_kg_m3, thickness_m and width_m ([clamped, free end]; the
/// thickness lies in the plane), count. Values: frequencies [Hz].
/// @throws DerivationError  where two functions fewer change an eigenvalue by more than 1e-14.
[[nodiscard]] std::vector<double> tapered_beam_program(const Json& arguments);

}  // namespace trammel::references
