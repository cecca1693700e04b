#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/model/evidence.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// Rigid kinematics of the planar 3-RRR manipulator: limbs A_i B_i C_i, active joints at A_i.
namespace trammel::solver {

/// Ratio of smallest to largest singular value below which a solution has no correct digit. Each
/// row of J_x contains about ten rounding errors.
inline constexpr double kSingularRatio = 64 * kEps;

using Eigen::Matrix3d;

/// Dimensions of the manipulator.
struct ManipulatorGeometry {
  std::array<Vector2d, 3> base;      ///< A_i, world [m]
  std::array<Vector2d, 3> platform;  ///< C_i relative to P in platform axes [m] (paper Eq. 23)
  std::array<double, 3> proximal{};  ///< |A_i B_i| [m]
  std::array<double, 3> distal{};    ///< |B_i C_i| [m]
  /// Side of the elbow, +1 or -1: theta_i = direction(A_i C_i) + working_mode_i * (angle at A_i).
  /// The paper uses -1 (elbow on the clockwise side of A_i C_i).
  std::array<int, 3> working_mode{-1, -1, -1};
};

/// Returns an equilateral triangle with A_1 at the origin and A_2 on the x axis.
/// @param side  length of a side [m].
[[nodiscard]] std::array<Vector2d, 3> equilateral_base(double side);
/// Returns an equilateral triangle about P, with C_i at 210, 330 and 90 degrees.
/// @param side  length of a side [m].
[[nodiscard]] std::array<Vector2d, 3> equilateral_platform(double side);
/// Returns the root mean square of |C_i - P| [m]. This length makes rotations comparable with
/// translations.
[[nodiscard]] double platform_radius(const ManipulatorGeometry& geometry);
/// Checks the dimensions.
/// @throws ModelError  if a length is not positive, a number is not finite, a mode is neither 1 nor
///   -1, or the platform is a point.
void check_geometry(const ManipulatorGeometry& geometry);

/// Position and orientation of the platform.
struct Pose {
  double x = 0;    ///< of P [m]
  double y = 0;    ///< of P [m]
  double phi = 0;  ///< platform orientation [rad]

  [[nodiscard]] Vector2d position() const { return {x, y}; }
  [[nodiscard]] Vector3d vector() const { return {x, y, phi}; }
};
/// Returns the pose (x, y [m], phi [rad]) given as a vector.
[[nodiscard]] inline Pose pose_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Joint positions and absolute link angles of a pose. Values of limbs that cannot reach the pose
/// are NaN.
struct Posture {
  Outcome outcome;  ///< singular: the reason states the limb that cannot reach, and the missing
                    ///< distance [m]
  std::array<Vector2d, 3> B, C;
  std::array<double, 3> active{};   ///< theta_ai: absolute angle of A_i B_i, in (-pi, pi] [rad]
  std::array<double, 3> passive{};  ///< absolute angle of B_i C_i, in (-pi, pi] [rad]
  /// sin(passive - active) [-], from the sides of the triangle A_i B_i C_i by Heron's formula. The
  /// factors are ordered according to Kahan. The result is accurate even if the limb is nearly
  /// straight or folded.
  std::array<double, 3> elbow_sine{};
  double closure_error = 0;  ///< largest | |C_i - B_i| - distal_i | [m]
};

/// Computes joint positions and link angles. The angle at A_i follows from the half-angle form,
/// with a, b, r = |A B|, |B C|, |A C|:
///
///   2 atan2(sqrt((b+r-a)(a+b-r)), sqrt((a+b+r)(a+r-b))).
///
/// The arc cosine of the cosine rule would lose half of the digits near full stretch. A limb that
/// is too short by at most round-off counts as straight.
/// @throws ModelError  as `check_geometry`, or if the pose is not finite.
[[nodiscard]] Posture inverse_kinematics(const ManipulatorGeometry& geometry, const Pose& pose);

/// Returns B_i of a limb within reach [m], by the formula of `inverse_kinematics`. With T = Dual
/// (numbers.h) it carries the derivative with respect to a link length at a fixed pose. The
/// derivative is infinite if the limb is straight or folded.
template <Real T>
[[nodiscard]] Eigen::Vector2<T> elbow_position(const Vector2d& A, const Vector2d& C,
                                               const T& proximal, const T& distal,
                                               int working_mode);

/// Pose of the assembly mode nearest to a start pose.
struct ForwardKinematics {
  Outcome outcome;  ///< singular: parallel singularity during the iteration; not_converged: no
                    ///< assembly nearby
  Pose pose;
  double closure_error = 0;  ///< as in Posture [m]
  int iterations = 0;
};
/// Finds the assembly mode nearest to `start` by Newton's method on |C_i - B_i|^2 = distal_i^2.
/// @param geometry  dimensions.
/// @param active  theta_ai [rad].
/// @param start  start pose.
[[nodiscard]] ForwardKinematics forward_kinematics(const ManipulatorGeometry& geometry,
                                                   const std::array<double, 3>& active,
                                                   const Pose& start);

/// Jacobian matrices of J_x (xdot, ydot, phidot) = J_q thetadot_a, from d_i . (Cdot_i - Bdot_i) =
/// 0.
struct Jacobians {
  Matrix3d parallel;  ///< J_x [m, m, m^2]: row i = (d_i^T, cross(C_i - P, d_i)), d_i = C_i - B_i
  Vector3d serial;    ///< diagonal of J_q [m^2]: cross(B_i - A_i, d_i)
  double platform_radius = 0;  ///< length that scales rotations [m]
  /// Distance from a parallel (second-kind) singularity [-]: 0 at the singularity, 1 at best. It is
  /// the smallest over the largest singular value of J_x. Rows are divided by |d_i| and the last
  /// column by the platform radius.
  double parallel_distance = 0;
  /// Distance from a serial (first-kind) singularity [-]: the smallest |sin(elbow angle)|. It is 0
  /// at the singularity and 1 at best.
  double serial_distance = 0;
};

/// Computes the Jacobian matrices.
/// @pre posture.outcome.solved()
[[nodiscard]] Jacobians jacobians(const ManipulatorGeometry& geometry, const Pose& pose,
                                  const Posture& posture);

/// Returns det J_x [m^4], which is 0 at a parallel singularity and NaN out of reach.
[[nodiscard]] double parallel_determinant(const ManipulatorGeometry& geometry, const Pose& pose);

/// Actuator torques that hold a platform under a wrench (paper Fig. 5).
struct HoldingTorques {
  Outcome outcome;   ///< singular: no finite torques hold the wrench at a parallel singularity
  Vector3d torque;   ///< of the actuators on the proximal links, counterclockwise [N m]
  Vector3d tension;  ///< axial force of the distal links, tension positive [N]
};

/// Computes holding torques by virtual work, torque . dtheta_a + wrench . dx = 0. With unit vectors
/// e_i = d_i / |d_i|, tensions T_i and torques tau_i satisfy
///
///   sum_i T_i (e_i, cross(C_i - P, e_i)) = wrench,
///   \f[ \tau_i = -T_i\, (B_i - A_i) \times e_i. \f]
///
/// At a serial singularity the torque of the limb is zero, and the result remains valid.
/// @param jacobians  Jacobian matrices of the pose.
/// @param wrench  (Fx, Fy [N], moment [N m]) applied to the platform at P.
[[nodiscard]] HoldingTorques holding_torques(const Jacobians& jacobians, const Vector3d& wrench);

}  // namespace trammel::solver
