#pragma once

#include <functional>

#include "solver/linear/system.h"

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

// How far a discrete solution is from a field that is known at every point: norms over the
// elements' interpolation, by quadrature. All errors are relative to the same norm of the exact
// field.

struct MembraneFieldPoint {
  Vector2d displacement = Vector2d::Zero();  ///< [m]
  double rotation = 0;                       ///< (dv/dx - du/dy) / 2 [rad]
  Vector3d stress = Vector3d::Zero();        ///< sxx, syy, sxy [Pa]
};

/// At a world point [m].
using MembraneField = std::function<MembraneFieldPoint(const Vector2d&)>;

/// L2 norms over the triangles; energy is the root of integral of sigma : epsilon of the error.
struct MembraneErrors {
  double displacement = 0;
  double rotation = 0;
  double stress = 0;
  double energy = 0;
};

/// @param q  free coordinates
[[nodiscard]] MembraneErrors membrane_errors(const System& system, const Eigen::VectorXd& q,
                                             const MembraneField& exact);

/// In the axes of the element: along it, and to its left. N = EA u', M = EI θ', V = -dM/dx where no
/// moment is distributed.
struct BeamFieldPoint {
  double axial = 0;           ///< [m]
  double deflection = 0;      ///< [m]
  double rotation = 0;        ///< [rad]
  double axial_force = 0;     ///< [N]
  double shear_force = 0;     ///< [N]
  double bending_moment = 0;  ///< [N m]
};

/// At a world point [m].
using BeamField = std::function<BeamFieldPoint(const Vector2d&)>;

/// L2 norms over the frame elements; energy is that of bending and, for Timoshenko members, shear.
/// The energy norm of stretching is `axial_force` where EA is uniform. Resultants are those of the
/// interpolation: M linear, N and V uniform in each element.
struct BeamErrors {
  double axial_displacement = 0;
  double deflection = 0;
  double rotation = 0;
  double axial_force = 0;
  double shear_force = 0;
  double bending_moment = 0;
  double energy = 0;
  double nodal_deflection = 0;  ///< largest at a node, relative to the largest deflection at one
  double nodal_rotation = 0;    ///< the same for rotations
};

[[nodiscard]] BeamErrors beam_errors(const System& system, const Eigen::VectorXd& q,
                                     const BeamField& exact);

}  // namespace trammel::solver
