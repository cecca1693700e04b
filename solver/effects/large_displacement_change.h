#pragma once

#include "solver/effects/linear_state.h"

namespace trammel::solver {

/// The change of a linear state by the turning of its forces with what they act in, to first order:
/// K du = -K_G u.
[[nodiscard]] StateChange change_by_geometric_stiffness(LinearState& state,
                                                        const Prestress& forces);

/// The change of a linear state by its own displacements: the chords shorten by
/// s = integral v'^2 / 2 dx, K du = -sum B^T EA s / L; the axial forces that this calls up stiffen,
/// and section forces turn with their sections.   Source: von Karman (1910).
/// @param largest_rotation  [rad]
[[nodiscard]] StateChange change_by_large_displacement(LinearState& state,
                                                       double& largest_rotation);

}  // namespace trammel::solver
