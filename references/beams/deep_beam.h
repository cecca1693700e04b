#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Forced vibration of a simply supported Timoshenko beam under a load uniform over its span, by
/// its exact modes w = sin(a x), psi = s cos(a x), a = n pi/L, s = a - rho w_n^2/(kappa G a), both
/// branches of each odd n (NAFEMS R0016, tests 5H and 5T).
namespace trammel::references {

/// Arguments: length_m, thickness_m (in the plane), width_m, E_Pa, rho_kg_m3, nu,
/// shear_coefficient, load_N_per_m; damping: damping_ratio (of every mode), or rayleigh_mass_1_s
/// and rayleigh_stiffness_s; response: static, harmonic-peak (largest steady amplitude about the
/// first mode) or step-peak (first maximum after the load is applied at once); outputs: array of
/// displacement_m (mid-span), stress_Pa (outer fibre at mid-span), frequency_Hz (of the peak
/// displacement), time_s (the same). Values: one an output.
[[nodiscard]] std::vector<double> deep_beam_program(const Json& arguments);

}  // namespace trammel::references
