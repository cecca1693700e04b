#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"

/// What a steadily rotating frame adds to the equations of the motion relative to it, at angular
/// speed W (counterclockwise) about a centre c. The acceleration of a mass at x is
///   u.. + 2 W J u. - W^2 (x - c + u),   J = [0 -1; 1 0],
/// so that M q.. + 2 W G q. + (K + K_G - W^2 S) q = f + W^2 f_c. Rotary inertia of point masses
/// feels neither term: as much of it is taken to lie along as across the axis. That of sections
/// feels none about the normal of the plane.
namespace trammel::solver {

/// About the normal of the plane, or about an axis in it: then the centrifugal forces pull away
/// from that axis alone, motion along the axis (the flapping of a blade) is not softened, and the
/// Coriolis forces point out of the plane, where nothing moves.
enum class RotationAxis { normal, x, y };

struct RotatingFrame {
  double speed = 0;                    ///< W [rad/s]
  Vector2d centre = Vector2d::Zero();  ///< c, a point of the axis [m]
  RotationAxis axis = RotationAxis::normal;
};

/// S: the mass of the motions away from the axis, q x q.
[[nodiscard]] SparseMatrix centrifugal_softening(const System& system,
                                                 RotationAxis axis = RotationAxis::normal);

/// G = integral rho N^T J N dV, q x q; skew.   Source: Coriolis force on the interpolation.
[[nodiscard]] SparseMatrix gyroscopic_matrix(const System& system);

/// Centrifugal forces W^2 integral rho N^T (x - c + u) dV on the unconstrained coordinates.
[[nodiscard]] Eigen::VectorXd centrifugal_forces(const System& system, const RotatingFrame& frame,
                                                 const Eigen::VectorXd& u);

/// The model's own body forces and the centrifugal ones of displacements u.
[[nodiscard]] BodyForces body_forces(const System& system, const RotatingFrame& frame,
                                     const Eigen::VectorXd& u);

}  // namespace trammel::solver
