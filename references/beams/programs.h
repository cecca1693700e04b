#pragma once

#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Programs that derive exact solutions of single beams, plates, pendulums and chains. programs.txt
/// lists their arguments. Only arguments that need an explanation are described in this file.
namespace trammel::references {

/// Computes in-plane frequencies of a free annular plate [Hz]. The argument modes is an array of
/// pairs [n, k]: the k-th elastic frequency with n waves around the circumference.
[[nodiscard]] std::vector<Real> annular_plate_inplane_program(const Arguments& arguments);

/// Computes critical end loads of a uniform column [N]. If the argument load is self-weight,
/// computes the critical factors of the distributed weight instead. EI_N_m2, length_m and
/// weight_N_per_m are 1 by default.
[[nodiscard]] std::vector<Real> column_buckling_program(const Arguments& arguments);

/// Computes the stability of a cantilever under follower loads: an end force P = p EI/L^2 along the
/// tangent at the tip (Beck), or a load q EI/L^3 per length along the tangent at each point
/// (Leipholz). Source: V. V. Bolotin, Nonconservative Problems of the Theory of Elastic Stability,
/// 1963, section 2.2. The deflection is v, the circular frequency is w, and x is the distance from
/// the tip divided by L. With W = w L^2 sqrt(rho A/EI), power series solve
///
///   v'''' + (p + q x) v'' = W^2 v.
///
/// The column flutters if its two lowest roots W meet: p = 20.0510, q = 40.0537.
/// The argument load_parameter is p or q. EI_N_m2, length_m and mass_kg_per_m are 1 by default.
/// Values: the flutter load [N or N/m], the two lowest frequencies [Hz], or the growth rate [1/s].
[[nodiscard]] std::vector<Real> becks_column_program(const Arguments& arguments);

/// Computes the exponent l of the displacements r^l at the distance r from a corner of a plate,
/// between a clamped and a free side. The result is the smallest real exponent above 0.1. Complex
/// exponents are ignored. The arguments clamped_side and free_side are directions [x, y] from the
/// corner. Plane stress is the default.
[[nodiscard]] std::vector<Real> wedge_exponent_program(const Arguments& arguments);

/// Computes the forced vibration of a simply supported Timoshenko beam under a uniform load. The
/// damping is damping_ratio (of every mode), or rayleigh_mass_1_s and rayleigh_stiffness_s. The
/// argument response is static, harmonic-peak (largest steady amplitude near the first resonance)
/// or step-peak (first maximum after a step load). Values, one per output: displacement_m
/// (mid-span), stress_Pa (outer fiber at mid-span), frequency_Hz or time_s (of the peak
/// displacement).
[[nodiscard]] std::vector<Real> forced_timoshenko_beam_program(const Arguments& arguments);

/// Computes large-displacement equilibria and limit points of a chain of straight elastic beams.
/// nodes_m: points [x, y] of the nodes; the first node is fixed in x and y.
/// EI_N_m2, EA_N, GA_N: stiffnesses of all beams; EA_N and GA_N are infinite by default.
/// start: rotation if the rotation of the first node is fixed, otherwise free.
/// end: list of the fixed motions of the last node (x, y, rotation), or free.
/// loads: rows [node, Fx, Fy, M] of the loads at load factor 1. Nodes are numbered from 0.
/// load_factors: load factors of the equilibria. Each solution starts from the previous one.
/// limit_points (instead of load_factors): initial values of each limit point. They are the moment
/// at the start (the angle if start is free), Fx and Fy at the start, and the load factor. Newton's
/// method corrects them until the load is stationary.
/// outputs: load_factor, displacement_x_m:NODE, displacement_y_m:NODE, rotation_rad:NODE.
/// steps: integration steps per beam (8 by default).
/// Values: all outputs of one equilibrium, then those of the next one.
/// @throws DerivationError  if Newton's method does not converge.
[[nodiscard]] std::vector<Real> elastic_chain_program(const Arguments& arguments);

/// Computes large deflections of a cantilever under a transverse load P at its tip (K. E. Bisshopp,
/// D. C. Drucker, Q. Appl. Math. 3, 1945, 272-275). The tip angle is phi, k^2 = (1 + sin phi)/2 and
/// sin t = 1/(k sqrt 2):
///
///   sqrt(P L^2/EI) = K(k) - F(t, k),
///   v/L = 1 - 2 (E(k) - E(t, k)) / sqrt(P L^2/EI),
///   u/L = 1 - sqrt(2 sin phi / (P L^2/EI)).
///
/// The argument load_parameter is an array of P L^2/EI > 0. Values for each load: transverse tip
/// displacement v/L, axial tip displacement u/L, phi [rad]. If the argument output is "transverse",
/// "shortening" or "angle": only v [m], u [m] (both require length_m) or phi.
[[nodiscard]] std::vector<Real> elastica_tip_force_program(const Arguments& arguments);

/// Computes large deflections of a cantilever under an axial load F beyond the buckling load Fcr
/// (S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., section 2.7). With the
/// angle alpha at the tip and k = sin(alpha/2):
///
///   F/Fcr = (2 K(k)/pi)^2,  height/L = 2 E(k)/K(k) - 1,  lateral/L = 2 k/K(k).
///
/// Values for each tip angle: F/Fcr, lateral displacement/L, axial displacement/L of the tip. If
/// the argument output is "load": only F/Fcr. If it is "lateral" or "axial", with length_m: only
/// this displacement [m].
[[nodiscard]] std::vector<Real> elastica_column_program(const Arguments& arguments);

/// Computes frequencies [Hz] of a clamped-clamped beam of the width b exp(-2 a x). The argument
/// width_rate_1_m is 2 a.
[[nodiscard]] std::vector<Real> exponential_beam_program(const Arguments& arguments);

/// Computes the motion of a chain of parallelogram loops. The argument start_speed_m_s is the speed
/// of the upper ends of the rods. Values for each time: x, y of the free end of the first rod
/// relative to its pivot [m], or the rates of x, y [m/s].
[[nodiscard]] std::vector<Real> parallelogram_chain_program(const Arguments& arguments);

/// Computes the motion of a plane pendulum that is released at rest at the angle a from the lower
/// vertical, counterclockwise positive. With k = sin(a/2) and w = sqrt(g/l), the angle theta at the
/// time t satisfies sin(theta/2) = k cd(w t, k), and the period is 4 K(k)/w. Values, depending on
/// the argument output: the period [s]; or for each time x and y of the mass relative to the pivot
/// [m]; or for each time the force of the rod on 1 kg, g (3 cos theta - 2 cos a) [N].
[[nodiscard]] std::vector<Real> pendulum_program(const Arguments& arguments);

/// Computes the displacement x [m] of a carriage on a spring, in which an unbalanced rotor starts
/// from rest. The natural angular frequency of the carriage is w (angular_frequency_rad_s). The
/// argument unbalance_m is m e/M, with the unbalanced mass m at the radius e and the total mass M.
/// The rotor has the angle a. Its speed a' increases from 0 to W (speed_rad_s) during the time T
/// (duration_s): a' = W (t/T - sin(2 pi t/T)/(2 pi)). The argument times_s is ascending and at most
/// T. Values: x at each time.
[[nodiscard]] std::vector<Real> rotor_run_up_program(const Arguments& arguments);

/// Computes bending frequencies [Hz] of a linearly tapered cantilever. The arguments thickness_m
/// (in the plane of bending) and width_m are pairs [clamped end, free end].
/// @throws DerivationError  if omitting two of the Rayleigh-Ritz functions changes an eigenvalue by
/// more than 1e-14.
[[nodiscard]] std::vector<Real> tapered_beam_program(const Arguments& arguments);

/// Computes dimensionless frequencies mu = w sqrt(rho A L^4/EI) of a rotating cantilever. The
/// argument eta is the dimensionless angular speed, Omega sqrt(rho A L^4/EI). With the argument
/// axial_ratio, EA L^2/EI, the beam is axially flexible. The Coriolis force then couples bending in
/// the plane of rotation to axial motion.
[[nodiscard]] std::vector<Real> rotating_beam_roots_program(const Arguments& arguments);

/// Computes frequencies [Hz] of a rotating cantilever that bends in the plane of rotation (plane
/// lag) or out of it (flap). The argument thickness_m is the thickness in the direction of bending.
[[nodiscard]] std::vector<Real> rotating_beam_frequencies_program(const Arguments& arguments);

/// Bending vibration of one uniform Euler-Bernoulli beam of length L. With the roots b = beta L of
/// its characteristic equation, f = b^2 / (2 pi L^2) sqrt(EI / rho A).
/// The equations are divided by cosh b, which avoids overflow (Blevins 1979, Table 8-1).
///
///   clamped-free                      cos b + sech b = 0
///   clamped-clamped, free-free        cos b - sech b = 0
///   clamped-pinned, pinned-free       sin b - cos b tanh b = 0
///   clamped-guided                    sin b + cos b tanh b = 0
///   pinned-pinned                     sin b = 0
///
/// Clamped-free with a tip mass mu = M/(rho A L) and a tip inertia j = J/(rho A L^3):
///
///   sech b + cos b + mu b (cos b tanh b - sin b) - j b^3 (sin b + cos b tanh b)
///     + mu j b^4 (sech b - cos b) = 0.
///
/// Rigid motions (b = 0) are omitted.
struct BeamEnds {
  std::string kind = "clamped-free";
  Real tip_mass_ratio = 0;     ///< mu = M/(rho A L) [-]
  Real tip_inertia_ratio = 0;  ///< j = J/(rho A L^3) [-]
};

/// Reads the arguments ends, tip_mass_ratio and tip_inertia_ratio of a beam.
[[nodiscard]] BeamEnds read_beam_ends(const Arguments& arguments);

/// Returns the first `count` roots beta L > 0 of the characteristic equation [-], to 45 digits.
/// @throws DerivationError  if fewer roots are found.
[[nodiscard]] std::vector<Real> beam_roots(const BeamEnds& ends, int count);

/// Computes the roots beta L of the characteristic equation of a uniform beam.
[[nodiscard]] std::vector<Real> beam_roots_program(const Arguments& arguments);

/// Computes natural frequencies of a uniform beam [Hz]. The thickness lies in the plane of bending.
[[nodiscard]] std::vector<Real> beam_frequencies_program(const Arguments& arguments);

/// Computes the fraction of the modal mass that the beam contributes, for each mode of a cantilever
/// with a tip mass. The mode shape is w(x), mu = M/(rho A L) is the tip mass ratio, and b = beta L
/// is the root of the mode:
///
///   int w^2 dx / (int w^2 dx + mu L w(L)^2) = 1 + 4 (mu / b) db/dmu.
///
/// By Rayleigh's principle, the relative change of a frequency with the tip mass follows from the
/// tip mass's fraction of the kinetic energy. db/dmu follows from the characteristic equation.
[[nodiscard]] std::vector<Real> beam_modal_mass_program(const Arguments& arguments);

}  // namespace trammel::references
