#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Exact large deflections of an inextensible cantilever of length L under a dead load at its tip,
/// by elliptic integrals.
namespace trammel::references {

/// Transverse load (K. E. Bisshopp, D. C. Drucker, Q. Appl. Math. 3, 1945, 272-275). With the tip
/// angle phi, k^2 = (1 + sin phi)/2 and sin t = 1/(k sqrt 2),
///   sqrt(P L^2/EI) = K(k) - F(t, k),  v/L = 1 - 2 (E(k) - E(t, k)) / sqrt(P L^2/EI),
///   u/L = 1 - sqrt(2 sin phi / (P L^2/EI)).
/// Arguments: load_parameter (array of P L^2/EI > 0). Values: v/L, u/L, phi [rad] for each; with
/// output "transverse", "shortening" (both with length_m) or "angle": v, u [m] or phi alone.
[[nodiscard]] std::vector<double> elastica_tip_force_program(const Json& arguments);

/// Axial load beyond buckling (S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed.,
/// section 2.7): k = sin(alpha/2), F/Fcr = (2 K(k)/pi)^2, height/L = 2 E(k)/K(k) - 1, lateral/L =
/// 2 k/K(k), alpha the angle at the tip.
/// Arguments: tip_angle_deg (array). Values: F/Fcr, lateral displacement/L, axial displacement/L
/// for each; with output "load", or "lateral" or "axial" with length_m: that alone, in m.
[[nodiscard]] std::vector<double> elastica_column_program(const Json& arguments);

}  // namespace trammel::references
