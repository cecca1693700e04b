#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/model/evidence.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// Rigid kinematics of the planar 3-RRR manipulator: limbs A_i B_i C_i, active joints at A_i.
namespace trammel::solver {

/// Below this singular value ratio not one digit of a solution can be trusted: the rows of J_x
/// carry some ten roundings each.
inline constexpr double kSingularRatio = 64 * kEps;

using Eigen::Matrix3d;

struct ManipulatorGeometry {
  std::array<Vector2d, 3> base;      ///< A_i, world [m]
  std::array<Vector2d, 3> platform;  ///< C_i from P in platform axes [m] (paper Eq. 23)
  std::array<double, 3> proximal{};  ///< |A_i B_i| [m]
  std::array<double, 3> distal{};    ///< |B_i C_i| [m]
  /// Side of the elbow: theta_i = direction(A_i C_i) + working_mode_i * (angle at A_i); +1 or -1,
  /// the paper's is -1 (elbow on the clockwise side).
  std::array<int, 3> working_mode{-1, -1, -1};
};

/// Equilateral triangle with A_1 at the origin and A_2 on the x axis, side [m].
[[nodiscard]] std::array<Vector2d, 3> equilateral_base(double side);
/// Equilateral triangle about P, C_i at 210, 330 and 90 degrees, side [m].
[[nodiscard]] std::array<Vector2d, 3> equilateral_platform(double side);
/// Root mean square of |C_i - P| [m], which makes rotations comparable with translations.
[[nodiscard]] double platform_radius(const ManipulatorGeometry& geometry);
/// @throws ModelError  where a length is not positive, a number not finite, a mode neither 1 nor -1
///                     or the platform a point.
void check_geometry(const ManipulatorGeometry& geometry);

struct Pose {
  double x = 0;    ///< of P [m]
  double y = 0;    ///< of P [m]
  double phi = 0;  ///< platform orientation [rad]

  [[nodiscard]] Vector2d position() const { return {x, y}; }
  [[nodiscard]] Vector3d vector() const { return {x, y, phi}; }
};
[[nodiscard]] inline Pose pose_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// All joint positions and absolute link angles of a pose. What is not reached is NaN.
struct Posture {
  Outcome outcome;  ///< singular: the reason names the limb that cannot reach, and by how much [m]
  std::array<Vector2d, 3> B, C;
  std::array<double, 3> active{};   ///< theta_ai: absolute angle of A_i B_i, in (-pi, pi] [rad]
  std::array<double, 3> passive{};  ///< absolute angle of B_i C_i, in (-pi, pi] [rad]
  /// sin(passive - active), from the sides of the triangle A_i B_i C_i by Heron's formula in
  /// Kahan's order, so that it keeps its digits when the limb is nearly straight or folded [-].
  std::array<double, 3> elbow_sine{};
  double closure_error = 0;  ///< largest | |C_i - B_i| - distal_i | [m]
};

/// Angle at A_i by the half-angle form 2 atan2(sqrt((b+r-a)(a+b-r)), sqrt((a+b+r)(a+r-b))), with
/// a, b, r = |A B|, |B C|, |A C|: the acos of the cosine rule would lose half of the digits near
/// full stretch. A limb short by no more than round-off counts as straight.
/// @throws ModelError  as `check_geometry`, or where the pose is not finite.
[[nodiscard]] Posture inverse_kinematics(const ManipulatorGeometry& geometry, const Pose& pose);

/// B_i of a limb within reach, by the same formulas. Over Dual (numbers.h) it carries the
/// derivative with respect to a link length, the pose held; infinite where the limb is straight or
/// folded.
template <Real T>
[[nodiscard]] Eigen::Vector2<T> elbow_position(const Vector2d& A, const Vector2d& C,
                                               const T& proximal, const T& distal,
                                               int working_mode);

/// The assembly mode nearest to `start`, by Newton's method on |C_i - B_i|^2 = distal_i^2.
struct ForwardKinematics {
  Outcome
      outcome;  ///< singular: a parallel singularity on the way; not_converged: no assembly near
  Pose pose;
  double closure_error = 0;  ///< as in Posture [m]
  int iterations = 0;
};
/// @param active  theta_ai [rad].
[[nodiscard]] ForwardKinematics forward_kinematics(const ManipulatorGeometry& geometry,
                                                   const std::array<double, 3>& active,
                                                   const Pose& start);

/// J_x (xdot, ydot, phidot) = J_q thetadot_a, from d_i . (Cdot_i - Bdot_i) = 0.
struct Jacobians {
  Matrix3d parallel;  ///< J_x [m, m, m^2]: row i = (d_i^T, cross(C_i - P, d_i)), d_i = C_i - B_i
  Vector3d serial;    ///< diagonal of J_q [m^2]: cross(B_i - A_i, d_i)
  double platform_radius = 0;  ///< scales a rotation [m]
  /// 0 at a parallel (second-kind) singularity, 1 at best: smallest over largest singular value of
  /// J_x with its rows divided by |d_i| and its last column by the platform radius [-].
  double parallel_distance = 0;
  /// 0 at a serial (first-kind) singularity, 1 at best: smallest |sin(elbow angle)| [-].
  double serial_distance = 0;
};

/// @pre posture.outcome.solved()
[[nodiscard]] Jacobians jacobians(const ManipulatorGeometry& geometry, const Pose& pose,
                                  const Posture& posture);

/// det J_x [m^4], 0 at a parallel singularity; NaN out of reach.
[[nodiscard]] double parallel_determinant(const ManipulatorGeometry& geometry, const Pose& pose);

/// What the actuators give to hold a platform that carries a wrench (paper Fig. 5).
struct HoldingTorques {
  Outcome outcome;   ///< singular: at a parallel singularity no finite torques hold the wrench
  Vector3d torque;   ///< of the actuators on the proximal links, counterclockwise [N m]
  Vector3d tension;  ///< axial force of the distal links, tension positive [N]
};

/// Virtual work: torque . dtheta_a + wrench . dx = 0. With unit vectors e_i = d_i / |d_i| the
/// tensions solve sum_i T_i (e_i, cross(C_i - P, e_i)) = wrench, and tau_i = -T_i cross(B_i - A_i,
/// e_i), so that a serial singularity needs no torque and does no harm.
/// @param wrench  (Fx, Fy [N], moment [N m]) applied to the platform at P.
[[nodiscard]] HoldingTorques holding_torques(const Jacobians& jacobians, const Vector3d& wrench);

}  // namespace trammel::solver
