#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "solver/manipulator/kinematics.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/outcome.h"

/// Rigid dynamics of the 3-RRR in nine coordinates (paper Eq. 1-5):
///   M(q) q.. + C(q, q.) q. + N(q) = forces,  q = [theta_a (3), theta_p (3), x, y, phi],
/// with absolute link angles, q. = W theta_a. by the closed loops, and the reduced
///   Mh theta_a.. + Ch theta_a. + Nh = tau + (dx/dtheta_a)^T wrench,
///   Mh = W^T M W,  Ch = W^T M W. + W^T C W,  Nh = W^T N.
namespace trammel::solver {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Matrix93d = Eigen::Matrix<double, 9, 3>;

struct RigidLink {
  double mass = 0;     ///< [kg]
  double center = 0;   ///< of mass, from the link's first joint along it [m]
  double inertia = 0;  ///< about the centre of mass [kg m^2]
};

struct RigidManipulator {
  ManipulatorGeometry geometry;
  std::array<RigidLink, 3> proximal, distal;
  PlatformMass platform;
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]
};

/// The bodies of a design. A link's inertia about its centre is the printed one, or m L^2 / 12.
/// (The flexible model spreads the mass over the length, which has that inertia by itself, and
/// carries a printed one on top, half at each end.)
/// @throws ModelError  as `link_section` and `platform_mass`.
[[nodiscard]] RigidManipulator rigid_manipulator(const ManipulatorDesign& design);

/// M [kg, kg m, kg m^2], symmetric. Scalar: double, or std::complex<double> for complex steps.
template <class Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 9, 9> mass_matrix(const RigidManipulator& manipulator,
                                                      const Eigen::Matrix<Scalar, 9, 1>& q);
/// W = [I; d theta_p / d theta_a; d(x, y, phi) / d theta_a].
/// @pre no parallel singularity
template <class Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 9, 3> motion_map(const RigidManipulator& manipulator,
                                                     const Eigen::Matrix<Scalar, 9, 1>& q);
/// Mh = W^T M W [kg m^2]; its derivative along a motion is Im(Mh(q + i h q.)) / h.
template <class Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 3> reduced_mass(const RigidManipulator& manipulator,
                                                       const Eigen::Matrix<Scalar, 9, 1>& q);

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

/// Plane motion of one body; position, velocity and acceleration of its centre of mass.
struct BodyMotion {
  Vector2d position, velocity, acceleration;
  double angle = 0, angular_velocity = 0, angular_acceleration = 0;
};

/// NaN unless solved.
struct InverseDynamics {
  Outcome outcome;  ///< as RigidTerms
  Vector9d q, q_dot, q_ddot;
  std::array<BodyMotion, 7> bodies;  ///< proximal 1-3, distal 1-3, platform
  Vector3d torque;                   ///< of the actuators on the proximal links [N m]
  double kinetic_energy = 0;         ///< [J]
  /// Rate of the kinetic energy, body by body: sum of m v . a + J omega alpha [W]. Power balance:
  /// kinetic_power = actuator_power + load_power + gravity_power.
  double kinetic_power = 0;
  double actuator_power = 0;
  double load_power = 0;
  double gravity_power = 0;
};

/// @param wrench  load on the platform at P: (Fx, Fy [N], moment [N m]) in world axes
[[nodiscard]] InverseDynamics inverse_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& motion,
                                               const Vector3d& wrench = Vector3d::Zero());

}  // namespace trammel::solver
