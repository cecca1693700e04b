#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/model.h"
#include "solver/outcome.h"

/// Rigid kinematics of the planar 3-RRR manipulator: limbs A_i B_i C_i, active joints at A_i.
namespace trammel {

using Eigen::Matrix3d;

struct ManipulatorGeometry {
  std::array<Vector2d, 3> base;      ///< A_i, world [m]
  std::array<Vector2d, 3> platform;  ///< C_i from P in platform axes [m] (paper Eq. 23)
  std::array<double, 3> proximal{};  ///< |A_i B_i| [m]
  std::array<double, 3> distal{};    ///< |B_i C_i| [m]
  /// Side of the elbow: theta_i = direction(A_i C_i) + working_mode_i * acos(...); the paper's is
  /// -1.
  std::array<int, 3> working_mode{-1, -1, -1};
};

struct Pose {
  double x = 0;    ///< of P [m]
  double y = 0;    ///< of P [m]
  double phi = 0;  ///< platform orientation [rad]
};

/// All joint positions and absolute link angles of a reachable pose.
struct Posture {
  Outcome outcome;  ///< singular: the reason names the limb that cannot reach, and by how much [m]
  std::array<Vector2d, 3> B, C;
  std::array<double, 3> active{};   ///< theta_ai: absolute angle of A_i B_i, in (-pi, pi] [rad]
  std::array<double, 3> passive{};  ///< absolute angle of B_i C_i, in (-pi, pi] [rad]
  double closure_error = 0;         ///< largest | |C_i - B_i| - distal_i | [m]
};

[[nodiscard]] Posture inverse_kinematics(const ManipulatorGeometry& geometry, const Pose& pose);

/// J_x (xdot, ydot, phidot) = J_q thetadot_a, each row divided by the link lengths so that it is
/// dimensionless for rotations scaled by the platform's circumradius.
struct Jacobians {
  Matrix3d parallel;  ///< J_x [m, m, m^2] : row i = (d_i^T, cross(C_i - P, d_i)), d_i = C_i - B_i
  Vector3d serial;    ///< diagonal of J_q [m^2]: cross(B_i - A_i, d_i)
  /// 0 at a parallel (second-kind) singularity, 1 at best: smallest over largest singular value of
  /// the dimensionless J_x.
  double parallel_distance = 0;
  /// 0 at a serial (first-kind) singularity: smallest |sin(elbow angle)|.
  double serial_distance = 0;
};

[[nodiscard]] Jacobians jacobians(const ManipulatorGeometry& geometry, const Pose& pose,
                                  const Posture& posture);

/// Actuator torques [N m] that hold the wrench (Fx, Fy [N], moment [N m]) applied to the platform
/// at P, by the rigid manipulator's Jacobian (paper Fig. 5).
[[nodiscard]] Vector3d holding_torques(const Jacobians& jacobians, const Vector3d& wrench);

}  // namespace trammel
