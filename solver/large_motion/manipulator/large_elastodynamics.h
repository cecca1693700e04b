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
/// give the rates of the deflection; the first is moved to where it holds with what damping takes
/// up at them.
/// not_converged: a path of equilibria or a step that does not reach its end.
/// @throws ModelError  as `solve_elastodynamics`; where it is `beyond_large_displacement`; without
///                     elastic inertia and times of samples.
[[nodiscard]] ElastodynamicsSolution solve_large_elastodynamics(
    const ElastodynamicsOptions& options);

/// What of a motion `solve_large_elastodynamics` does not know; null where it knows all.
/// @param model  of the manipulator where the motion starts
[[nodiscard]] const char* beyond_large_displacement(const ElastodynamicsOptions& options,
                                                    const Model& model);

}  // namespace trammel::solver
