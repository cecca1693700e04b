#pragma once

#include "solver/manipulator/limb.h"
#include "solver/model/outcome.h"

/// Rigid dynamics of the 3-RRR in nine coordinates (paper Eq. 1-5):
///   M(q) q.. + C(q, q.) q. + N(q) = forces,  q = [theta_a (3), theta_p (3), x, y, phi],
/// with absolute link angles, q. = W theta_a. by the closed loops, and the reduced
///   Mh theta_a.. + Ch theta_a. + Nh = tau + (dx/dtheta_a)^T wrench,
///   Mh = W^T M W,  Ch = W^T M W. + W^T C W,  Nh = W^T N.
namespace trammel::solver {

/// All terms of Eq. 1-5 in one state; NaN unless solved.
struct RigidTerms {
  /// singular: out of reach, at a parallel singularity (no W) or at a serial one (the velocity of
  /// the platform asks for an infinite one of an actuator)
  Outcome outcome;
  Vector9d q, q_dot;
  Matrix9d M;
  Matrix9d C;  ///< of Christoffel symbols, so that M. - 2 C is skew-symmetric
  Vector9d N;  ///< gravity, dV/dq [N, N m]
  Matrix93d W, W_dot;
  Matrix3d Mh, Ch;  ///< Mh symmetric positive definite; Mh. - 2 Ch skew-symmetric
  Vector3d Nh;
};

/// M [kg, kg m, kg m^2], symmetric; for double and std::complex<double>.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 9, 9> mass_matrix(const RigidManipulator& m,
                                                 const Eigen::Matrix<S, 9, 1>& q);

/// Mh = W^T M W [kg m^2]; its derivative along a motion is Im(Mh(q + i h q.)) / h.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 3, 3> reduced_mass(const RigidManipulator& m,
                                                  const Eigen::Matrix<S, 9, 1>& q);

/// @param velocity  of the platform (xdot, ydot [m/s], phidot [rad/s])
/// @throws ModelError  as `inverse_kinematics`.
[[nodiscard]] RigidTerms rigid_terms(const RigidManipulator& manipulator, const Pose& pose,
                                     const Vector3d& velocity);

/// How well the two properties of Eq. 4, 5 hold in one state.
struct PropertyResiduals {
  double symmetry = 0;  ///< |Mh - Mh^T| / |Mh| [-]
  /// |S + S^T| / (|Mh.| + 2 |Ch|) of S = Mh. - 2 Ch, with Mh. by complex step, which knows nothing
  /// of C; 0 at a standstill [-]
  double skewness = 0;
  double min_eigenvalue = 0;  ///< of Mh [kg m^2]
};

/// @pre terms.outcome.solved()
[[nodiscard]] PropertyResiduals property_residuals(const RigidManipulator& manipulator,
                                                   const RigidTerms& terms);

}  // namespace trammel::solver
