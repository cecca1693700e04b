#pragma once

#include <functional>

#include "solver/linear/system.h"

/// Loads that are functions of position. Quadrature converts these loads to consistent nodal
/// forces, the integral of N^T load. The nodal forces are added to `load` and `f` of the system.
namespace trammel::solver {

/// Function that returns the force per volume [N/m^3] at a position in world axes [m].
using BodyForce = std::function<Vector2d(const Vector2d&)>;

/// Function that returns the force per area [Pa] on a boundary. Its arguments are the position in
/// world axes [m] and the outward unit normal [-].
using Traction = std::function<Vector2d(const Vector2d&, const Vector2d&)>;

/// Function that returns the force per length along world x, y [N/m] and the moment per length [N
/// m/m] at a position in world axes [m].
using LineLoad = std::function<Vector3d(const Vector2d&)>;

/// Adds a body force on all triangles.
void add_body_force(System& system, const BodyForce& force);

/// Adds a traction on the boundary, which consists of all sides with only one adjacent triangle.
/// Forces on supported coordinates act on the ground.
/// @pre The nodes of each triangle are in counterclockwise order, as in all models from case files
///   and mesh functions.
void add_edge_traction(System& system, const Traction& traction);

/// Adds a line load on all frame elements except bars.
void add_line_load(System& system, const LineLoad& load);

// Errors of a finite element solution compared with an exact field. The errors are norms over the
// interpolation of the elements, computed by quadrature. Each error is relative to the same norm of
// the exact field.

/// Displacement, rotation and stress of a plane-stress field at a point.
struct MembraneFieldPoint {
  /// Displacement (u, v) [m].
  Vector2d displacement = Vector2d::Zero();
  /// Rotation (dv/dx - du/dy) / 2 [rad].
  double rotation = 0;
  /// Stresses sxx, syy, sxy [Pa].
  Vector3d stress = Vector3d::Zero();
};

/// Function that returns a plane-stress field at a position in world axes [m].
using MembraneField = std::function<MembraneFieldPoint(const Vector2d&)>;

/// Relative errors of a plane-stress solution in L2 norms over the triangles [-]. The norm of the
/// energy error is the square root of the integral of sigma : epsilon.
struct MembraneErrors {
  double displacement = 0;
  double rotation = 0;
  double stress = 0;
  double energy = 0;
};

/// Returns the errors of a plane-stress solution with the free coordinates q.
[[nodiscard]] MembraneErrors membrane_errors(const System& system, const Eigen::VectorXd& q,
                                             const MembraneField& exact);

/// Displacements and section forces of a beam at a point, in element axes: x along the element and
/// y to the left of x. N = EA u', M = EI θ', and V = -dM/dx without distributed moments.
struct BeamFieldPoint {
  /// Displacement along the element [m].
  double axial = 0;
  /// Displacement normal to the element [m].
  double deflection = 0;
  /// Rotation of the section [rad].
  double rotation = 0;
  /// Axial force N [N].
  double axial_force = 0;
  /// Shear force V [N].
  double shear_force = 0;
  /// Bending moment M [N m].
  double bending_moment = 0;
};

/// Function that returns displacements and section forces of a beam at a position in world axes
/// [m].
using BeamField = std::function<BeamFieldPoint(const Vector2d&)>;

/// Relative errors of a frame solution in L2 norms over the frame elements [-]. The energy error
/// includes bending and, for Timoshenko members, shear. If EA is uniform, `axial_force` is also the
/// energy error of stretching. The section forces follow from the interpolation: M is linear in
/// each element, and N and V are uniform in each element.
struct BeamErrors {
  double axial_displacement = 0;
  double deflection = 0;
  double rotation = 0;
  double axial_force = 0;
  double shear_force = 0;
  double bending_moment = 0;
  double energy = 0;
  /// Largest error of a nodal deflection, divided by the largest exact nodal deflection.
  double nodal_deflection = 0;
  /// Largest error of a nodal rotation, divided by the largest exact nodal rotation.
  double nodal_rotation = 0;
};

/// Returns the errors of a frame solution with the free coordinates q.
[[nodiscard]] BeamErrors beam_errors(const System& system, const Eigen::VectorXd& q,
                                     const BeamField& exact);

}  // namespace trammel::solver
