#pragma once

#include <Eigen/Core>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Equations of motion relative to a frame that rotates with constant angular speed Omega
/// (counterclockwise) about a center c. The acceleration of a mass at x is
///
///   \f[ \ddot u + 2 \Omega J \dot u - \Omega^2 (x - c + u), \quad
///       J = \begin{bmatrix} 0 & -1 \\ 1 & 0 \end{bmatrix}. \f]
///
/// The equation of motion is
///
///   \f[ M \ddot q + 2 \Omega G \dot q + (K + K_G - \Omega^2 S) q = f + \Omega^2 f_c. \f]
///
/// G is `gyroscopic_matrix`, S is `centrifugal_softening`, and Omega^2 f_c are the centrifugal
/// forces on the undeformed structure. K_G is the geometric stiffness of the internal forces.
///
/// The Coriolis and centrifugal terms do not act on the rotary inertia of point masses, which is
/// assumed equal along and across the axis. They do not act on the rotary inertia of sections if
/// the axis is normal to the plane.
namespace trammel::solver {

/// Axis of rotation: the normal of the plane, or an axis in the plane. An axis in the plane has
/// these effects:
///
/// - Centrifugal forces point away from the axis.
/// - Motion along the axis (flapping of a blade) is not softened.
/// - Coriolis forces are normal to the plane, in which direction nothing moves.
enum class RotationAxis { normal, x, y };

/// Steady rotation of a reference frame.
struct RotatingFrame {
  double speed = 0;                    ///< Omega [rad/s]
  Vector2d center = Vector2d::Zero();  ///< c, a point on the axis [m]
  RotationAxis axis = RotationAxis::normal;
};

/// Returns S, the mass matrix of motions perpendicular to the axis of rotation, q x q [SI].
[[nodiscard]] SparseMatrix centrifugal_softening(const System& system,
                                                 RotationAxis axis = RotationAxis::normal);

/// Returns the matrix of the Coriolis forces, G = integral rho N^T J N dV, with the interpolation N
/// of the displacements, q x q, skew-symmetric [SI].
[[nodiscard]] SparseMatrix gyroscopic_matrix(const System& system);

/// Returns the centrifugal forces Omega^2 integral rho N^T (x - c + u) dV on the unconstrained
/// coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd centrifugal_forces(const System& system, const RotatingFrame& frame,
                                                 const Eigen::VectorXd& u);

/// Returns the body forces of the model plus the centrifugal forces at displacements u.
[[nodiscard]] BodyForces body_forces(const System& system, const RotatingFrame& frame,
                                     const Eigen::VectorXd& u);

struct RotatingOptions {
  RotatingFrame frame;
  Index count = 6;
  EigenMethod method =
      EigenMethod::automatic;  ///< for a stable state; an unstable state requires the dense method
  bool gyroscopic = true;      ///< false: omit the Coriolis forces G
  bool stiffening = true;      ///< false: omit the geometric stiffness K_G
  /// true: K_G follows from the forces in the steady state. false: K_G follows from linear statics
  /// under the centrifugal forces on the undeformed structure, as in the classical equations of
  /// blades.
  bool prestress_at_steady_state = true;
};

/// Small vibrations about the steady state of a rotating frame, relative to the frame. The steady
/// state and the modes satisfy
///
///   \f[ (K + K_G - \Omega^2 S) q = f + \Omega^2 f_c, \f]
///   \f[ (K + K_G - \Omega^2 S + 2 i \omega \Omega G - \omega^2 M) x = 0. \f]
///
/// The supports rotate with the frame, and the geometry is undeformed.
///
/// Stable states have real omega. Their modes solve a Hermitian problem in 1 / omega, and are
/// counted completely: at an omega just above the last mode, the matrix of the second equation has
/// as many negative pivots as there are lower modes.
struct RotatingModes {
  Outcome outcome;              ///< singular: a mechanism; not_converged: see the reason
  Eigen::VectorXd q;            ///< steady state, free coordinates; see node_motion
  bool stable = true;           ///< false: the amplitude of at least one mode grows
  Eigen::VectorXd frequency;    ///< ascending [Hz]; 0 for monotonic growth
  Eigen::VectorXd growth_rate;  ///< growth rate of each mode [1/s]; 0 in a stable state
  Eigen::MatrixXcd shape;       ///< free coordinate x mode, q(t) = Re(x e^{i w t}), |x| = 1
  Evidence evidence;
  Counters counters;
};

/// Computes the steady state of a rotating frame and the modes about it.
[[nodiscard]] RotatingModes solve_rotating_modes(const System& system,
                                                 const RotatingOptions& options);

}  // namespace trammel::solver
