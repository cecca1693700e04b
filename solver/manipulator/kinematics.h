#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/model/evidence.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// Rigid kinematics of the planar 3-RRR manipulator: limbs A_i B_i C_i, active joints at A_i.
namespace trammel::solver {

/// Ratio of the smallest to the largest singular value of the Jacobian matrix J_x up to which a
/// pose is treated as singular. Each row of J_x contains about ten round-off errors, so that
/// equations with J_x then have no correct digit.
inline constexpr double kSingularRatio = 64 * kEps;

using Eigen::Matrix3d;

/// Dimensions of the manipulator. The platform joints are defined as in Varalakshmi & Srinivas
/// (2017), Eq. 23.
struct ManipulatorGeometry {
  std::array<Vector2d, 3> base;      ///< positions of the base joints A_i, world axes [m]
  std::array<Vector2d, 3> platform;  ///< joint positions C_i relative to P, platform axes [m]
  std::array<double, 3> proximal{};  ///< lengths |A_i B_i| of the proximal links [m]
  std::array<double, 3> distal{};    ///< lengths |B_i C_i| of the distal links [m]
  /// Side of A_i C_i on which the elbow B_i lies: +1 counterclockwise, -1 clockwise (Varalakshmi &
  /// Srinivas 2017). The angle of A_i B_i is direction(A_i C_i) + working_mode_i * (angle between
  /// A_i C_i and A_i B_i).
  std::array<int, 3> working_mode{-1, -1, -1};
};

/// Returns the positions of the base joints A_i on an equilateral triangle with the given side
/// length [m]. A_1 is at the origin and A_2 on the x axis.
[[nodiscard]] std::array<Vector2d, 3> equilateral_base(double side);
/// Returns the positions of the platform joints C_i relative to P on an equilateral triangle with
/// the given side length [m] and center P. C_1, C_2 and C_3 are at 210, 330 and 90 degrees.
[[nodiscard]] std::array<Vector2d, 3> equilateral_platform(double side);
/// Returns the root mean square of |C_i - P| [m]. The product of a rotation and this length is
/// comparable with a translation.
[[nodiscard]] double platform_radius(const ManipulatorGeometry& geometry);
/// Checks the dimensions of the manipulator.
/// @throws ModelError  if a link length is not positive, a length or coordinate is not finite, a
///   working mode is neither 1 nor -1, or all platform joints are at P.
void check_geometry(const ManipulatorGeometry& geometry);

/// Position and orientation of the platform.
struct Pose {
  double x = 0;    ///< x coordinate of the platform point P, world axes [m]
  double y = 0;    ///< y coordinate of the platform point P, world axes [m]
  double phi = 0;  ///< platform orientation [rad]

  [[nodiscard]] Vector2d position() const { return {x, y}; }
  [[nodiscard]] Vector3d vector() const { return {x, y, phi}; }
};
/// Converts a vector (x, y [m], phi [rad]) to a pose.
[[nodiscard]] inline Pose pose_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Joint positions and absolute link angles of the manipulator at a pose. If a limb cannot reach
/// the pose, the elbow position and the angles of the limb are NaN.
struct Posture {
  /// singular: a limb cannot reach the pose, or C_i is at A_i and both links of limb i are equally
  /// long. The reason names the limb.
  Outcome outcome;
  std::array<Vector2d, 3> B, C;
  std::array<double, 3> active{};   ///< theta_ai: absolute angle of A_i B_i, in (-pi, pi] [rad]
  std::array<double, 3> passive{};  ///< absolute angle of B_i C_i, in (-pi, pi] [rad]
  /// Sine of the elbow angle [-]. The elbow angle is the angle of B_i C_i minus the angle of A_i
  /// B_i. The sine is computed from the sides of the triangle A_i B_i C_i by Heron's formula with
  /// Kahan's order of the factors. The sine is therefore accurate even if the limb is nearly
  /// straight or folded.
  std::array<double, 3> elbow_sine{};
  double closure_error = 0;  ///< largest error of a distal length, | |C_i - B_i| - distal_i | [m]
};

/// Computes joint positions and link angles from the pose of the platform. The angle of the
/// triangle A_i B_i C_i at A_i follows from its sides a = |A B|, b = |B C|, r = |A C| by the
/// half-angle formula:
///
///   2 atan2(sqrt((b+r-a)(a+b-r)), sqrt((a+b+r)(a+r-b))).
///
/// The arc cosine of the cosine rule would lose half of the digits for a nearly straight limb. A
/// limb that is too short by at most the round-off error is treated as straight.
/// @throws ModelError  as `check_geometry`, or if the pose is not finite.
[[nodiscard]] Posture inverse_kinematics(const ManipulatorGeometry& geometry, const Pose& pose);

/// Returns the elbow position B_i of a limb that can reach C_i [m], by the formula of
/// `inverse_kinematics`. With T = Dual (numbers.h), the result includes the derivative of B_i by a
/// link length at a fixed pose. The derivative is infinite if the limb is straight or folded.
template <Real T>
[[nodiscard]] Eigen::Vector2<T> elbow_position(const Vector2d& A, const Vector2d& C,
                                               const T& proximal, const T& distal,
                                               int working_mode);

/// Pose of the platform for given actuator angles, in the assembly mode nearest to a start pose.
struct ForwardKinematics {
  /// singular: the iteration passed a parallel singularity. not_converged: no pose was found near
  /// the start pose.
  Outcome outcome;
  Pose pose;
  /// Largest difference between |C_i - B_i| and the length of distal link i [m].
  double closure_error = 0;
  int iterations = 0;
};
/// Computes the pose of the platform from the absolute angles of the proximal links [rad]. Newton's
/// method solves the loop equations |C_i - B_i|^2 = distal_i^2, starting at `start`.
[[nodiscard]] ForwardKinematics forward_kinematics(const ManipulatorGeometry& geometry,
                                                   const std::array<double, 3>& angles,
                                                   const Pose& start);

/// Jacobian matrices J_x and J_q between platform and actuator rates, J_x (xdot, ydot, phidot) =
/// J_q thetadot_a. They follow from d_i . (Cdot_i - Bdot_i) = 0, with d_i = C_i - B_i.
struct Jacobians {
  Matrix3d parallel;  ///< J_x [m, m, m^2]: row i = (d_i^T, cross(C_i - P, d_i)), d_i = C_i - B_i
  Vector3d serial;    ///< diagonal of J_q [m^2]: cross(B_i - A_i, d_i)
  /// Factor on rotations for the comparison with translations: the platform radius [m].
  double platform_radius = 0;
  /// Distance from a parallel (second-kind) singularity [-]: 0 at the singularity, 1 at best. This
  /// distance is the ratio of the smallest to the largest singular value of J_x. For this
  /// ratio, each row of J_x is divided by |d_i|, and the last column by the platform radius.
  double parallel_distance = 0;
  /// Distance from a serial (first-kind) singularity [-]: the smallest |sin(elbow angle)| of the
  /// three limbs. The distance is 0 at the singularity and 1 at best.
  double serial_distance = 0;
};

/// Computes the Jacobian matrices of the manipulator at a pose.
/// @pre posture.outcome.solved()
[[nodiscard]] Jacobians jacobians(const ManipulatorGeometry& geometry, const Pose& pose,
                                  const Posture& posture);

/// Returns the determinant of the Jacobian matrix J_x [m^4]. The determinant is 0 at a parallel
/// singularity and NaN if a limb cannot reach the pose.
[[nodiscard]] double parallel_determinant(const ManipulatorGeometry& geometry, const Pose& pose);

/// Actuator torques that hold the platform in equilibrium under a wrench (Varalakshmi & Srinivas
/// 2017, Fig. 5).
struct HoldingTorques {
  Outcome outcome;   ///< singular: at a parallel singularity, no finite torques balance the wrench
  Vector3d torque;   ///< actuator torques on the proximal links, counterclockwise [N m]
  Vector3d tension;  ///< axial forces of the distal links, tension positive [N]
};

/// Computes holding torques by virtual work, torque . dtheta_a + wrench . dx = 0. With unit vectors
/// e_i from B_i to C_i, tensions T_i of the distal links and torques tau_i satisfy
///
///   sum_i T_i (e_i, cross(C_i - P, e_i)) = wrench,
///   \f[ \tau_i = -T_i\, (B_i - A_i) \times e_i. \f]
///
/// At a serial singularity, the torque of the singular limb is zero, and the result is valid.
/// @param jacobians  Jacobian matrices of the pose.
/// @param wrench  (Fx, Fy [N], moment [N m]) applied to the platform at P.
[[nodiscard]] HoldingTorques holding_torques(const Jacobians& jacobians, const Vector3d& wrench);

}  // namespace trammel::solver
