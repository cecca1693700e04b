#pragma once

#include <string>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

/// Bending vibration of one uniform Euler-Bernoulli beam of length L: roots b = beta L of its
/// characteristic equation, f = b^2 / (2 pi L^2) sqrt(EI / rho A).
/// The equations are divided by cosh b, which avoids overflow (Blevins 1979, Table 8-1).
///   clamped-free                      cos b + sech b = 0
///   clamped-clamped, free-free        cos b - sech b = 0
///   clamped-pinned, pinned-free       sin b - cos b tanh b = 0
///   clamped-guided                    sin b + cos b tanh b = 0
///   pinned-pinned                     sin b = 0
/// and for clamped-free with a tip mass mu = M/(rho A L) and a tip inertia j = J/(rho A L^3)
///   sech b + cos b + mu b (cos b tanh b - sin b) - j b^3 (sin b + cos b tanh b)
///     + mu j b^4 (sech b - cos b) = 0.
/// Rigid motions (b = 0) are omitted.
namespace trammel::references {

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

/// The beam's share of the modal mass of a cantilever with the tip mass mu, one a root b:
///   int w^2 dx / (int w^2 dx + mu L w(L)^2) = 1 + 4 (mu / b) db/dmu,
/// for the frequency falls with the tip mass as the tip mass's share of the kinetic energy
/// (Rayleigh), and db/dmu follows from the characteristic equation. Arguments: tip_mass_ratio,
/// count. Values: shares [-].
[[nodiscard]] std::vector<Real> beam_modal_mass_program(const Arguments& arguments);

}  // namespace trammel::references
