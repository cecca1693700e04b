#pragma once

#include <Eigen/Core>
#include <utility>
#include <variant>
#include <vector>

#include "solver/manipulator/kinematics.h"

/// Prescribed motions of the platform: pose, velocity and acceleration at every time.
namespace trammel::solver {

/// Error: a path is invalid, or does not include a requested time.
class PathError : public ModelError {
 public:
  using ModelError::ModelError;
};

/// Pose, velocity and acceleration of the platform at a time.
struct TrajectoryPoint {
  double time = 0;  ///< time of the point [s]
  Pose pose;
  Vector3d velocity = Vector3d::Zero();      ///< (xdot, ydot [m/s], phidot [rad/s])
  Vector3d acceleration = Vector3d::Zero();  ///< (xddot, yddot [m/s^2], phiddot [rad/s^2])
};

/// Circle x = x_c + r cos(w t), y = y_c + r sin(w t) with constant phi (Varalakshmi & Srinivas
/// 2017, Eq. 38, with w = 1 rad/s).
struct Circle {
  Vector2d center = Vector2d::Zero();  ///< center of the circle [m]
  double radius = 0;                   ///< radius of the circle [m]
  double angular_speed = 1;            ///< angular speed w on the circle [rad/s]
  double phi = 0;                      ///< constant orientation of the platform [rad]
};

/// Motion at constant velocity. The platform is at `from` at t = 0 and at `to` at t = duration, and
/// continues to move before and after.
struct Line {
  Pose from, to;
  double duration = 1;  ///< > 0 [s]
};

/// Motion from rest in `from` to rest in `to`. The traveled fraction is s = 10 u^3 - 15 u^4 + 6 u^5
/// with u = t / duration. Velocity and acceleration vanish at both ends. The platform is at rest
/// before and after the motion.
struct RestToRest {
  Pose from, to;
  double duration = 1;  ///< > 0 [s]
};

/// Given poses, interpolated by the cubic spline with continuous acceleration.
struct Spline {
  std::vector<double> times;      ///< times of the given poses, strictly ascending [s]
  Eigen::MatrixX3d pose;          ///< one row (x, y [m], phi [rad]) per time
  Eigen::MatrixX3d acceleration;  ///< accelerations at `times`, from `make_spline`
};

/// End conditions of a spline. natural: zero acceleration at both ends; at_rest: zero velocity at
/// both ends; periodic: equal first and last pose, velocity and acceleration.
enum class SplineEnds { natural, at_rest, periodic };

/// Computes a spline through given poses.
/// @throws ModelError  if the number of poses is less than three, a number is not finite, the times
///   do not ascend, or the first and last poses of a periodic spline differ.
[[nodiscard]] Spline make_spline(const std::vector<double>& times, const std::vector<Pose>& poses,
                                 SplineEnds ends);

/// Prescribed motion of the platform.
using Path = std::variant<Circle, Line, RestToRest, Spline>;

/// Returns the motion of the platform on a path at a time.
/// @throws ModelError  if the path is invalid, or the time is outside the range of a spline.
[[nodiscard]] TrajectoryPoint at(const Path& path, double time);

/// Returns the first and the last time of the path [s]. Both times are infinite unless the path is
/// a spline.
[[nodiscard]] std::pair<double, double> time_span(const Path& path);

/// Returns true if the platform is at rest at all times.
[[nodiscard]] bool is_at_rest(const Path& path);

/// Returns the motion on a path at the times 0, step, 2 step, ... , (points - 1) step.
/// @throws ModelError  as `at`, or if points < 1 or the step is not positive.
[[nodiscard]] std::vector<TrajectoryPoint> sample(const Path& path, Index points, double step);

}  // namespace trammel::solver
