#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

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

struct RotatingOptions {
  RotatingFrame frame;
  Index count = 6;
  EigenMethod method =
      EigenMethod::automatic;  ///< of a stable state; an unstable one is always dense
  bool gyroscopic = true;      ///< false: leaves G out
  bool stiffening = true;      ///< false: leaves K_G out
  /// K_G from the forces in the steady state; false: from those of linear statics under the
  /// centrifugal forces on the undeformed frame, as the classical equations of blades have it.
  bool prestress_at_steady_state = true;
};

/// Small vibration of a frame that rotates steadily, seen from it, about its steady state:
///   (K + K_G - W^2 S) q = f + W^2 f_c,   and with that K_G
///   (K + K_G - W^2 S + i w 2 W G - w^2 M) x = 0
/// (rotating_frame.h for S, G, f_c). The supports rotate with the frame; the geometry is the
/// undeformed one.
///
/// Stable states have real w: a Hermitian problem in 1 / w, of which none is missed, for the matrix
/// above at a w just beyond the last has as many negative pivots as there are below it.
struct RotatingModes {
  Outcome outcome;              ///< singular: a mechanism; not_converged: see the reason
  Eigen::VectorXd q;            ///< steady state, free coordinates; see node_motion
  bool stable = true;           ///< false where a motion grows
  Eigen::VectorXd frequency;    ///< ascending [Hz]; 0 for what grows without turning over
  Eigen::VectorXd growth_rate;  ///< of each [1/s]; 0 in a stable state
  Eigen::MatrixXcd shape;       ///< free coordinate x mode, q(t) = Re(x e^{i w t}), |x| = 1
  Evidence evidence;
  Counters counters;
};

[[nodiscard]] RotatingModes solve_rotating_modes(const System& system,
                                                 const RotatingOptions& options);

}  // namespace trammel::solver
