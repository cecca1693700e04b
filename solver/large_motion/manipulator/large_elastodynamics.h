#pragma once

#include "solver/elastodynamics/elastodynamics.h"

namespace trammel::solver {

/// Elastodynamics with large displacement, in the geometrically exact tier (solver/large_motion):
/// what vibrates and how it starts as in `solve_elastodynamics`. Actuators follow the path exactly;
/// where a joint is welded or sprung, one link's turn against the other is driven as in the nominal
/// motion, in which nothing is stressed. Without elastic inertia every sample is an equilibrium
/// under loads, weight and nominal inertia. Displacements are from the nominal position, section
/// forces along the axes of the rotated sections; there are no stresses, energies and numbers of
/// effects, and no quasi-static motion beside a dynamic one. Gyroscopic terms cannot be left out.
/// Schemes become generalized-alpha with their spectral radius at infinite frequency. Steps end
/// where samples are asked for and the load history bends. A quasi-static start: three equilibria
/// give velocities, what damping takes up at them acts on three more, whose velocities start it.
/// not_converged: a path of equilibria or a step that does not reach its end.
/// @throws ModelError  as `solve_elastodynamics`; where an actuator is free or Eq. 25 ties
///                     rotations; for modal superposition, error control, schemes that are stable
///                     for small steps only, jumps of the load, and missing nominal inertia.
[[nodiscard]] ElastodynamicsSolution solve_large_elastodynamics(
    const ElastodynamicsOptions& options);

}  // namespace trammel::solver
