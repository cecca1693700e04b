#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Equilibria of a plane chain of straight elastic pieces, welded to each other, at any
/// displacement, by shooting: Taylor series of degree 30 along the pieces, Newton's method in
/// extended precision (E. Reissner, On one-dimensional finite-strain beam theory, ZAMP 23, 1972,
/// 795-804). With the section's angle t, the force F and the moment m of what follows on it,
///   t' = t0' + m/EI,  r' = (1 + F.a/EA) a + (F.b/GA) b,  m' = -r' x F,
/// a = (cos t, sin t), b = (-sin t, cos t); no EA: inextensible, no GA: no shear.
namespace trammel::references {

/// Arguments: nodes_m (points [x, y]; the first is held in x and y), EI_N_m2; EA_N, GA_N; start and
/// end: which of x, y, rotation are held, or free (of the start: rotation, or free to turn); loads
/// (array of [node, Fx, Fy, M], node from 0); load_factors (each found from the one before), or
/// guesses of limit points, [first angle or moment, Fx, Fy of the first section, load factor], each
/// polished until the load is stationary; outputs (load_factor, displacement_x_m:NODE,
/// displacement_y_m:NODE, rotation_rad:NODE), all of a solution, then of the next; steps per piece
/// (4).
/// @throws DerivationError  where Newton's method does not converge.
[[nodiscard]] std::vector<double> elastic_chain_program(const Json& arguments);

}  // namespace trammel::references
