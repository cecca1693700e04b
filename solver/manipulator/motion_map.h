#pragma once

#include "solver/manipulator/limb.h"

/// The closed loops of the rigid manipulator, q. = W theta_a. . The loop P + c = A + l1 a + l2 e
/// of a limb gives, along e and along perp(e),
///   e . C. = l1 s theta_a.,   perp(e) . C. = l1 (a . e) theta_a. + l2 theta_p.,  s = cross(a, e).
namespace trammel::solver {

/// W = [I; d theta_p / d theta_a; d(x, y, phi) / d theta_a]. Scalar: double, or
/// std::complex<double> for complex steps.
/// @pre no parallel singularity
template <class S>
[[nodiscard]] Eigen::Matrix<S, 9, 3> motion_map(const RigidManipulator& manipulator,
                                                const Vec9<S>& q);

/// W. : the same equations differentiated along q. .
[[nodiscard]] Matrix93d motion_map_rate(const RigidManipulator& manipulator, const Vector9d& q,
                                        const Vector9d& q_dot, const Matrix93d& W);

/// q. = W theta_a. from the motion of the platform.
/// @param velocity  of the platform (xdot, ydot [m/s], phidot [rad/s])
[[nodiscard]] Vector9d velocities(const RigidManipulator& manipulator, const Vector9d& q,
                                  const Vector3d& velocity);
/// q.. from the acceleration of the platform.
[[nodiscard]] Vector9d accelerations(const RigidManipulator& manipulator, const Vector9d& q,
                                     const Vector9d& q_dot, const Vector3d& acceleration);

}  // namespace trammel::solver
