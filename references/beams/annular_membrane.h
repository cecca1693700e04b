#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// In-plane vibration of a free annular plate in plane stress, n waves around. With a = w/c_p,
/// c_p^2 = E/(rho (1 - nu^2)), b = w/c_s, c_s^2 = G/rho, the potentials phi and psi are J_n and Y_n
/// of a r and b r, and
///   u_r = phi' + n psi/r,  u_t = -n phi/r - psi',
///   s_r ~ phi'' + nu (phi'/r - n^2 phi/r^2) + (1 - nu) n (psi/r)',
///   t_rt ~ -2 n (phi/r)' - (psi'' - psi'/r + n^2 psi/r^2)
/// vanish at both radii (A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th
/// ed., chapter XXII). For n = 0 radial and torsional motions are found in one list.
namespace trammel::references {

/// Arguments: inner_radius_m, outer_radius_m, E_Pa, rho_kg_m3, nu, modes (array of pairs [n, k]:
/// the k-th elastic frequency with n waves). Values: [Hz].
[[nodiscard]] std::vector<double> annular_membrane_program(const Json& arguments);

}  // namespace trammel::references
