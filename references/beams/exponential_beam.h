#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Bending vibration of a clamped-clamped beam of constant thickness whose width is
/// b exp(-2 a x): its equations have constant coefficients. With r^2 = I/A, P = z^2 - a^2,
/// kG = kappa G / rho, e = E / rho,
///   Euler-Bernoulli:  P^2 = w^2 / (e r^2)
///   Timoshenko:       (kG P + w^2)(e r^2 P - kG + w^2 r^2) = -kG^2 P
/// and solutions exp(a x) {cosh z x, sinh z x}, whose deflection and rotation vanish at both ends.
namespace trammel::references {

/// Arguments: length_m, thickness_m, width_rate_1_m (2 a), E_Pa, rho_kg_m3, count, beam
/// (euler-bernoulli | timoshenko), nu and shear_coefficient for the latter. Values: [Hz].
[[nodiscard]] std::vector<double> exponential_beam_program(const Json& arguments);

}  // namespace trammel::references
