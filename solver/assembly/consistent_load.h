#pragma once

#include <functional>

#include "solver/assembly/system.h"

/// Loads given as functions of position, turned into consistent nodal forces (integral of N^T load)
/// by quadrature and added to the system's `load` and `f`.
namespace trammel::solver {

/// World point [m] -> force per volume [N/m^3].
using BodyForce = std::function<Vector2d(const Vector2d&)>;

/// World point [m], outward normal [-] -> force per area [Pa].
using Traction = std::function<Vector2d(const Vector2d&, const Vector2d&)>;

/// World point [m] -> force per length along world x, y [N/m] and moment per length [N m/m].
using LineLoad = std::function<Vector3d(const Vector2d&)>;

/// On all triangles.
void add_body_force(System& system, const BodyForce& force);

/// On every side that belongs to one triangle only. What falls on supported coordinates goes to the
/// ground.
/// @pre the triangles run counterclockwise, as readers and meshes make them
void add_edge_traction(System& system, const Traction& traction);

/// On all frame elements that bend.
void add_line_load(System& system, const LineLoad& load);

}  // namespace trammel::solver
