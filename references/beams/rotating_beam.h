#pragma once

#include <optional>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

/// Bending vibration of a uniform Euler-Bernoulli cantilever on a hub that rotates steadily
/// (A. D. Wright et al., J. Appl. Mech. 49, 1982, 197-202). With x over L, eta = Omega
/// sqrt(rho A L^4/EI), hub ratio r = R/L, mu = w sqrt(rho A L^4/EI) and the tension of the
/// undeformed beam, t = eta^2 ((1 - x^2)/2 + r (1 - x)):
///   flap (out of the plane of rotation)  V'''' - (t V')' - mu^2 V = 0;
///   lag (in the plane), axially rigid    V'''' - (t V')' - (mu^2 + eta^2) V = 0;
///   lag with the Coriolis coupling to axial motion U, s = EA L^2/EI,
///     V'''' - (t V')' - (mu^2 + eta^2) V - 2 eta mu U = 0,
///     s U'' + (mu^2 + eta^2) U + 2 eta mu V = 0.
/// Solved by power series about the hub in extended precision.
namespace trammel::references {

struct RotatingBeam {
  Real eta = 0;
  Real hub_ratio = 0;
  bool in_plane = false;
  std::optional<Real> axial_ratio;  ///< s; in the plane only, none: axially rigid
};

/// The first `count` values of mu.
/// @throws DerivationError  where the axially rigid beam diverges in the plane.
[[nodiscard]] std::vector<Real> rotating_beam_roots(const RotatingBeam& beam, int count);

/// Arguments: eta, hub_ratio, plane (flap | lag), count, axial_ratio (for the Coriolis coupling).
/// Values: mu.
[[nodiscard]] std::vector<double> rotating_beam_roots_program(const Json& arguments);

/// Arguments: length_m, hub_radius_m, E_Pa, rho_kg_m3, thickness_m (in the direction of bending),
/// angular_speed_rad_s, plane, count, axial (rigid | flexible). Values: frequencies [Hz].
[[nodiscard]] std::vector<double> rotating_beam_frequencies_program(const Json& arguments);

}  // namespace trammel::references
