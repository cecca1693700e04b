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
/// The Coriolis and centrifugal terms do not act on the rotary inertia of point masses, whose mass
/// is assumed to be distributed equally along and across the axis. If the axis is normal to the
/// plane, these terms do not act on the rotary inertia of sections either.
namespace trammel::solver {

/// Axis of rotation: the normal of the plane, or an axis in the plane. An axis in the plane has the
/// following effects:
///
/// - Centrifugal forces point away from the axis.
/// - Motion along the axis (flapping of a blade) is not softened.
/// - Coriolis forces are normal to the plane. The planar model does not move in this direction.
enum class RotationAxis { normal, x, y };

/// Steady rotation of a reference frame.
struct RotatingFrame {
  /// Angular speed Omega [rad/s].
  double speed = 0;
  /// Center c, a point on the axis of rotation [m].
  Vector2d center = Vector2d::Zero();
  RotationAxis axis = RotationAxis::normal;
};

/// Returns the matrix S, which is the mass matrix of motions perpendicular to the axis of rotation,
/// q x q [SI].
[[nodiscard]] SparseMatrix centrifugal_softening(const System& system,
                                                 RotationAxis axis = RotationAxis::normal);

/// Returns the skew-symmetric matrix G of the Coriolis forces, G = integral rho N^T J N dV, q x q
/// [SI]. N is the interpolation of the displacements.
[[nodiscard]] SparseMatrix gyroscopic_matrix(const System& system);

/// Returns the centrifugal forces on the unconstrained coordinates [N, N m], Omega^2 integral rho
/// N^T (x - c + u) dV. N is the interpolation of the displacements u, x the undeformed position,
/// and c the center of rotation.
[[nodiscard]] Eigen::VectorXd centrifugal_forces(const System& system, const RotatingFrame& frame,
                                                 const Eigen::VectorXd& u);

/// Returns the body forces of the model plus the centrifugal forces, which include the effect of
/// displacements u.
[[nodiscard]] BodyForces body_forces(const System& system, const RotatingFrame& frame,
                                     const Eigen::VectorXd& u);

struct RotatingOptions {
  RotatingFrame frame;
  Index count = 6;
  EigenMethod method =
      EigenMethod::automatic;  ///< for a stable state; an unstable state requires the dense method
  bool gyroscopic = true;      ///< false: omit the Coriolis forces
  bool stiffening = true;      ///< false: omit the geometric stiffness K_G
  /// true: K_G follows from the internal forces in the steady state. false: K_G follows from linear
  /// statics under the centrifugal forces on the undeformed structure, as in the classical
  /// equations of blades.
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
/// Stable states have real omega. Their modes solve a Hermitian problem in 1 / omega, and no mode
/// is missing. At an omega just above the last mode, the matrix of the second equation must have as
/// many negative pivots as there are modes with lower omega.
struct RotatingModes {
  /// singular: the model is a mechanism. not_converged: see Outcome::reason.
  Outcome outcome;
  /// Steady state in free coordinates; `node_motion` converts it to node displacements.
  Eigen::VectorXd q;
  bool stable = true;  ///< false: the amplitude of at least one mode grows
  /// Frequencies, ascending [Hz]; 0 for a mode that grows without oscillation.
  Eigen::VectorXd frequency;
  Eigen::VectorXd growth_rate;  ///< growth rate of each mode [1/s]; 0 in a stable state
  Eigen::MatrixXcd shape;       ///< free coordinate x mode, q(t) = Re(x e^{i w t}), |x| = 1
  Evidence evidence;
  Counters counters;
};

/// Computes the steady state of a model in a rotating frame and the vibration modes about this
/// state.
[[nodiscard]] RotatingModes solve_rotating_modes(const System& system,
                                                 const RotatingOptions& options);

}  // namespace trammel::solver
