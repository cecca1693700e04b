#pragma once

#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Programs that derive exact solutions of single beams, plates, pendulums and chains.
namespace trammel::references {

/// Arguments: inner_radius_m, outer_radius_m, E_Pa, rho_kg_m3, nu, modes (array of pairs [n, k]:
/// the k-th elastic frequency with n waves). Values: [Hz].
[[nodiscard]] std::vector<Real> annular_membrane_program(const Arguments& arguments);

/// Arguments: ends, load (end | self-weight), count; EI_N_m2, length_m, weight_N_per_m (1 each by
/// default). Values: critical end loads [N], or the critical multiple of the weight.
[[nodiscard]] std::vector<Real> column_buckling_program(const Arguments& arguments);

/// A cantilever under follower loads: an end force P = p EI/L^2 along the tangent at the tip
/// (Beck), or a load q EI/L^3 per length along the tangent at each point (Leipholz). Source: V. V.
/// Bolotin, Nonconservative Problems of the Theory of Elastic Stability, 1963, section 2.2. With x
/// from the tip over L and W = w L^2 sqrt(rho A/EI), power series solve
///
///   v'''' + (p + q x) v'' = W^2 v.
///
/// The column flutters if its two lowest roots meet: p = 20.0510, q = 40.0537.
/// Arguments: output (flutter-load | frequencies | growth-rate), load (tip | spread),
/// load_parameter p or q (not for the first), EI_N_m2, length_m, mass_kg_per_m (1 each by default).
/// Values: the load [N or N/m], the two lowest frequencies [Hz], or the rate of growth [1/s].
[[nodiscard]] std::vector<Real> becks_column_program(const Arguments& arguments);

/// Arguments: clamped_side, free_side (directions [x, y] from the corner), nu,
/// plane (stress by default, or strain). Value: the smallest l, if it is real.
[[nodiscard]] std::vector<Real> wedge_exponent_program(const Arguments& arguments);

/// Arguments: length_m, thickness_m (in the plane), width_m, E_Pa, rho_kg_m3, nu,
/// shear_coefficient, load_N_per_m; damping: damping_ratio (of every mode), or rayleigh_mass_1_s
/// and rayleigh_stiffness_s; response: static, harmonic-peak (largest steady amplitude about the
/// first mode) or step-peak (first maximum after the load is applied at once); outputs: array of
/// displacement_m (mid-span), stress_Pa (outer fiber at mid-span), frequency_Hz (of the peak
/// displacement), time_s (of the peak displacement). Values: one per output.
[[nodiscard]] std::vector<Real> deep_beam_program(const Arguments& arguments);

/// Arguments:
/// nodes_m: points [x, y]; the first is fixed in x and y.
/// EI_N_m2; EA_N, GA_N (both infinite by default).
/// start, end: lists of the fixed motions x, y, rotation, or free; start: rotation or free.
/// loads: rows [node, Fx, Fy, M], node from 0.
/// load_factors, each solved from the solution of the previous one; or
/// limit_points: guesses [first angle or moment, Fx, Fy of the first section, load factor]. They
/// are refined until the load is stationary.
/// outputs: load_factor, displacement_x_m:NODE, displacement_y_m:NODE, rotation_rad:NODE.
/// steps: steps per piece (8 by default).
/// Values: all outputs of one solution, then those of the next one.
/// @throws DerivationError  if Newton's method does not converge.
[[nodiscard]] std::vector<Real> elastic_chain_program(const Arguments& arguments);

/// Transverse load (K. E. Bisshopp, D. C. Drucker, Q. Appl. Math. 3, 1945, 272-275). With the tip
/// angle phi, k^2 = (1 + sin phi)/2 and sin t = 1/(k sqrt 2):
///
///   sqrt(P L^2/EI) = K(k) - F(t, k),
///
///   v/L = 1 - 2 (E(k) - E(t, k)) / sqrt(P L^2/EI),
///
///   u/L = 1 - sqrt(2 sin phi / (P L^2/EI)).
///
/// Arguments: load_parameter (array of P L^2/EI > 0). Values: v/L, u/L, phi [rad] for each. With
/// output "transverse", "shortening" (both with length_m) or "angle": v, u [m] or phi alone.
[[nodiscard]] std::vector<Real> elastica_tip_force_program(const Arguments& arguments);

/// Axial load beyond buckling (S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed.,
/// section 2.7). With the angle alpha at the tip and k = sin(alpha/2):
///
///   F/Fcr = (2 K(k)/pi)^2,  height/L = 2 E(k)/K(k) - 1,  lateral/L = 2 k/K(k).
///
/// Arguments: tip_angle_deg (array). Values: F/Fcr, lateral displacement/L, axial displacement/L
/// for each. With output "load", or "lateral" or "axial" with length_m: that alone, in m.
[[nodiscard]] std::vector<Real> elastica_column_program(const Arguments& arguments);

/// Arguments: length_m, thickness_m, width_rate_1_m (2 a), E_Pa, rho_kg_m3, count, beam
/// (euler-bernoulli | timoshenko), nu and shear_coefficient for timoshenko. Values: [Hz].
[[nodiscard]] std::vector<Real> exponential_beam_program(const Arguments& arguments);

/// Arguments: loops (N), length_m, gravity_m_s2, start_speed_m_s (of the rods' upper ends),
/// times_s, output (position | velocity). Values: x, y of the first rod's free end from its pivot
/// [m], or their rates [m/s], for each time.
[[nodiscard]] std::vector<Real> parallelogram_chain_program(const Arguments& arguments);

/// Released at rest at the angle a from the lower vertical, counterclockwise positive. With
/// k = sin(a/2) and w = sqrt(g/l), sin(theta/2) = k cd(w t, k), and the period is 4 K(k)/w.
/// Arguments: length_m, gravity_m_s2, start_angle_deg, output (period | position |
/// tension), times_s (for the last two). Values: the period [s]. For each time: x and y from the
/// pivot [m], or the force of the rod on 1 kg, g (3 cos theta - 2 cos a) [N].
[[nodiscard]] std::vector<Real> pendulum_program(const Arguments& arguments);

/// Arguments: unbalance_m (m e/M), angular_frequency_rad_s (w), speed_rad_s (W) and duration_s (T)
/// of a' = W (t/T - sin(2 pi t/T)/(2 pi)), times_s, ascending, at most T. Values: x [m] at each.
[[nodiscard]] std::vector<Real> run_up_program(const Arguments& arguments);

/// Arguments: length_m, E_Pa, rho_kg_m3, thickness_m and width_m ([clamped, free end]; the
/// thickness lies in the plane), count. Values: frequencies [Hz].
/// @throws DerivationError  if two functions fewer change an eigenvalue by more than 1e-14.
[[nodiscard]] std::vector<Real> tapered_beam_program(const Arguments& arguments);

/// Arguments: eta, hub_ratio, plane (flap | lag), count, axial_ratio (for the Coriolis coupling).
/// Values: mu.
[[nodiscard]] std::vector<Real> rotating_beam_roots_program(const Arguments& arguments);

/// Arguments: length_m, hub_radius_m, E_Pa, rho_kg_m3, thickness_m (in the direction of bending),
/// angular_speed_rad_s, plane, count, axial (rigid | flexible). Values: frequencies [Hz].
[[nodiscard]] std::vector<Real> rotating_beam_frequencies_program(const Arguments& arguments);

/// Bending vibration of one uniform Euler-Bernoulli beam of length L. With the roots b = beta L of
/// its characteristic equation, f = b^2 / (2 pi L^2) sqrt(EI / rho A).
/// The equations are divided by cosh b, which avoids overflow (Blevins 1979, Table 8-1).
///
///   clamped-free                      cos b + sech b = 0
///   clamped-clamped, free-free        cos b - sech b = 0
///
///   clamped-pinned, pinned-free       sin b - cos b tanh b = 0
///
///   clamped-guided                    sin b + cos b tanh b = 0
///   pinned-pinned                     sin b = 0
///
/// Clamped-free with a tip mass mu = M/(rho A L) and a tip inertia j = J/(rho A L^3):
///
///   sech b + cos b + mu b (cos b tanh b - sin b) - j b^3 (sin b + cos b tanh b)
///
///     + mu j b^4 (sech b - cos b) = 0.
///
/// Rigid motions (b = 0) are omitted.
struct BeamEnds {
  std::string kind = "clamped-free";
  Real tip_mass_ratio = 0;     ///< mu [-]
  Real tip_inertia_ratio = 0;  ///< j [-]
};

/// Reads the arguments ends, tip_mass_ratio, tip_inertia_ratio. @throws DerivationError
[[nodiscard]] BeamEnds read_beam_ends(const Arguments& arguments);

/// The first `count` roots beta L > 0 [-], to 45 digits.
/// @throws DerivationError  if fewer are found.
[[nodiscard]] std::vector<Real> beam_roots(const BeamEnds& ends, int count);

/// Arguments: ends, count, tip_mass_ratio, tip_inertia_ratio. Values: beta L.
[[nodiscard]] std::vector<Real> beam_roots_program(const Arguments& arguments);

/// Arguments: as beam-roots, and length_m, E_Pa, rho_kg_m3, thickness_m (in the plane), width_m.
/// Values: frequencies [Hz].
[[nodiscard]] std::vector<Real> beam_frequencies_program(const Arguments& arguments);

/// Fraction of the modal mass that the beam contributes, for a cantilever with the tip mass ratio
/// mu and each root b:
///
///   int w^2 dx / (int w^2 dx + mu L w(L)^2) = 1 + 4 (mu / b) db/dmu.
///
/// By Rayleigh, the relative change of a frequency with the tip mass is the fraction of the kinetic
/// energy that the tip mass has; db/dmu follows from the characteristic equation. Arguments:
/// tip_mass_ratio, count. Values: fractions [-].
[[nodiscard]] std::vector<Real> beam_modal_mass_program(const Arguments& arguments);

}  // namespace trammel::references
