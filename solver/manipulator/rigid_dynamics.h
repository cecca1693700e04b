#pragma once

#include <array>

#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

/// Rigid dynamics of the 3-RRR manipulator in nine coordinates (Varalakshmi & Srinivas 2017, Eq.
/// 1-5), with absolute link angles:
///
///   M(q) q.. + C(q, q.) q. + N(q) = forces,  q = [theta_a (3), theta_p (3), x, y, phi].
///
/// A dot denotes the time derivative. N is the derivative of the potential energy of gravity by q.
/// The forces on the right-hand side are those of the actuators, the load and the closed loops. The
/// closed loops require q. = W theta_a., which gives the reduced equation
///
///   Mh theta_a.. + Ch theta_a. + Nh = tau + (dx/dtheta_a)^T wrench,
///
///   Mh = W^T M W,  Ch = W^T M W. + W^T C W,  Nh = W^T N.
///
/// The actuator torques are tau, and dx/dtheta_a is the matrix of the last three rows of W. The
/// wrench acts on the platform at P. Unit vectors along proximal and distal link are a and e, the
/// link lengths are l1 and l2, and c = C - P. The time derivative of the loop equation P + c = A +
/// l1 a + l2 e of a limb has these components along e and along perp(e):
///
///   e . C. = l1 s theta_a.,   perp(e) . C. = l1 (a . e) theta_a. + l2 theta_p.,  s = cross(a, e).
///
/// Templates over T are defined for double and for dual numbers (Dual). The derivatives of the dual
/// numbers are rates, from which W. and the accelerations follow.
namespace trammel::solver {

template <class T>
using Vector9 = Eigen::Matrix<T, 9, 1>;
using Vector9d = Vector9<double>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Matrix93d = Eigen::Matrix<double, 9, 3>;

/// Mass properties of a rigid link.
struct RigidLink {
  double mass = 0;     ///< mass of the link [kg]
  double center = 0;   ///< distance of the center of mass from the first joint of the link [m]
  double inertia = 0;  ///< moment of inertia about the center of mass [kg m^2]
};

/// Mass properties and dimensions of the rigid bodies of the manipulator, and gravity.
struct RigidManipulator {
  ManipulatorGeometry geometry;
  std::array<RigidLink, 3> proximal, distal;
  PlatformMass platform;
  Vector2d gravity = Vector2d::Zero();  ///< acceleration of gravity [m/s^2]
};

/// Returns the rigid bodies of a design. The inertia of a link about its center is the value in the
/// design, or m L^2 / 12 if the design contains no value. (In the flexible model, the value in the
/// design is added to the inertia of the distributed mass, half at each end.)
/// @throws ModelError  as `link_section` and `platform_mass`.
[[nodiscard]] RigidManipulator rigid_manipulator(const ManipulatorDesign& design);

/// Returns dual numbers with the given values, and with the given rates as their derivatives.
template <int n>
[[nodiscard]] Eigen::Matrix<Dual, n, 1> with_rates(const Eigen::Matrix<double, n, 1>& values,
                                                   const Eigen::Matrix<double, n, 1>& rates) {
  return values.binaryExpr(rates, [](double x, double rate) { return with_derivative(x, rate); });
}
/// Returns the derivatives (rates) of dual numbers.
template <int n, int m>
[[nodiscard]] Eigen::Matrix<double, n, m> rates_of(const Eigen::Matrix<Dual, n, m>& values) {
  return values.unaryExpr([](const Dual& x) { return derivative(x); });
}

/// Returns the values of dual numbers without their rates.
template <int n, int m>
[[nodiscard]] Eigen::Matrix<double, n, m> values_of(const Eigen::Matrix<Dual, n, m>& values) {
  return values.unaryExpr([](const Dual& x) { return x.value(); });
}

/// Returns the symmetric mass matrix M [kg, kg m, kg m^2]. The derivatives of the dual numbers are
/// the time derivative of M.
[[nodiscard]] Eigen::Matrix<Dual, 9, 9> mass_matrix(const RigidManipulator& m,
                                                    const Vector9<Dual>& q);

/// Returns the matrix W = [I; d theta_p / d theta_a; d(x, y, phi) / d theta_a] of q. = W theta_a.
/// @pre The pose is no parallel singularity.
template <Real T>
[[nodiscard]] Eigen::Matrix<T, 9, 3> actuator_to_joint_jacobian(const RigidManipulator& m,
                                                                const Vector9<T>& q);

/// Returns the velocities q. = W theta_a. of the nine coordinates from the velocity of the platform
/// (xdot, ydot [m/s], phidot [rad/s]).
template <Real T>
[[nodiscard]] Vector9<T> joint_velocities(const RigidManipulator& m, const Vector9<T>& q,
                                          const Eigen::Matrix<T, 3, 1>& platform_rate);

/// Inertia, position and Jacobian matrix J of a body. J gives the velocity of the center of mass
/// and the angular velocity, (xdot, ydot, omega) = J qdot.
struct BodyTerms {
  Vector3d inertia;   ///< mass, mass, and inertia about the center of mass [kg, kg, kg m^2]
  Vector2d position;  ///< position of the center of mass [m]
  Eigen::Matrix<double, 3, 9> J, J_dot;
};

/// Terms of the equations of motion (Varalakshmi & Srinivas 2017, Eq. 1-5) at one pose and
/// velocity. All terms are NaN unless the outcome is solved.
struct RigidTerms {
  /// singular: the pose is out of reach, at a parallel singularity (no W), or at a serial
  /// singularity. At a serial singularity, the velocity of the platform requires an infinite
  /// velocity of an actuator.
  Outcome outcome;
  Vector9d q = Vector9d::Constant(kNaN), q_dot = q;
  Matrix9d M = Matrix9d::Constant(kNaN);
  Matrix9d C = M;  ///< sum of J^T diag(inertia) dJ/dt; dM/dt - 2 C is skew-symmetric
  Vector9d N = q;  ///< gravity, dV/dq of the potential energy V [N, N m]
  Matrix93d W = Matrix93d::Constant(kNaN), W_dot = W;
  /// Mass matrix Mh and velocity matrix Ch of the equation of motion that is reduced to the
  /// actuator angles. Mh is symmetric positive definite, and dMh/dt - 2 Ch is skew-symmetric.
  Matrix3d Mh = Matrix3d::Constant(kNaN), Ch = Mh;
  Vector3d Nh = Vector3d::Constant(kNaN);
  std::array<BodyTerms, 7> bodies;  ///< proximal links 1-3, distal links 1-3, platform
};

/// Computes the terms of the equations of motion at a pose and velocity (xdot, ydot [m/s], phidot
/// [rad/s]) of the platform.
/// @throws ModelError  as `inverse_kinematics`.
[[nodiscard]] RigidTerms rigid_terms(const RigidManipulator& manipulator, const Pose& pose,
                                     const Vector3d& velocity);

/// Residuals of the symmetry of the mass matrix Mh and the skew symmetry of dMh/dt - 2 Ch, at one
/// pose and velocity. Source: Varalakshmi & Srinivas (2017), Eq. 4, 5.
struct PropertyResiduals {
  double symmetry = 0;  ///< |Mh - Mh^T| / |Mh| [-]
  /// Relative size |S + S^T| / (|Mh.| + 2 |Ch|) of the symmetric part of S = Mh. - 2 Ch [-]. Mh. is
  /// computed independently of C. The result is 0 at rest.
  double skewness = 0;
  double min_eigenvalue = 0;  ///< smallest eigenvalue of Mh [kg m^2]
};

/// Computes the residuals of the symmetry of Mh and the skew symmetry of dMh/dt - 2 Ch at the pose
/// and velocity of `terms`.
/// @pre terms.outcome.solved()
[[nodiscard]] PropertyResiduals property_residuals(const RigidManipulator& manipulator,
                                                   const RigidTerms& terms);

// Inverse dynamics: motion of all bodies, torques and powers of the rigid manipulator on its path.

/// Plane motion of one body: position, velocity and acceleration of its center of mass.
struct BodyMotion {
  Vector2d position = Vector2d::Constant(kNaN), velocity = position, acceleration = position;
  double angle = kNaN, angular_velocity = kNaN, angular_acceleration = kNaN;
};

/// Torques, energies and motion of all bodies. All numbers are NaN unless the outcome is solved.
struct InverseDynamics {
  /// Outcome with the statuses of RigidTerms.
  Outcome outcome;
  Vector9d q = Vector9d::Constant(kNaN), q_dot = q, q_ddot = q;
  std::array<BodyMotion, 7> bodies;            ///< proximal links 1-3, distal links 1-3, platform
  Vector3d torque = Vector3d::Constant(kNaN);  ///< actuator torques on the proximal links [N m]
  double kinetic_energy = kNaN;                ///< kinetic energy of all bodies [J]
  double potential_energy = kNaN;              ///< energy in the gravity field, -sum m g . x [J]
  /// Rate of the kinetic energy: the sum of m v . a + J omega alpha over the bodies [W]. The power
  /// balance is
  ///
  ///   kinetic_power = actuator_power + load_power + gravity_power.
  double kinetic_power = kNaN;
  double actuator_power = kNaN;
  double load_power = kNaN;
  double gravity_power = kNaN;
};

/// Computes actuator torques and energies for a motion of the platform. The wrench (Fx, Fy [N],
/// moment [N m]) acts on the platform at P, in world axes.
[[nodiscard]] InverseDynamics inverse_dynamics(const RigidManipulator& manipulator,
                                               const TrajectoryPoint& motion,
                                               const Vector3d& wrench = Vector3d::Zero());

}  // namespace trammel::solver
