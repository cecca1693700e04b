#pragma once

#include <Eigen/Core>
#include <utility>
#include <variant>
#include <vector>

#include "solver/manipulator/kinematics.h"

/// Prescribed motions of the platform: pose, velocity and acceleration at every time.
namespace trammel::solver {

/// A path that has no meaning, or does not reach as far in time as it is asked.
class PathError : public ModelError {
 public:
  using ModelError::ModelError;
};

struct TrajectoryPoint {
  double time = 0;  ///< [s]
  Pose pose;
  Vector3d velocity = Vector3d::Zero();      ///< (xdot, ydot [m/s], phidot [rad/s])
  Vector3d acceleration = Vector3d::Zero();  ///< (xddot, yddot [m/s^2], phiddot [rad/s^2])
};

/// x = x_c + r cos(w t), y = y_c + r sin(w t), phi held (paper Eq. 38, with w = 1 rad/s).
struct Circle {
  Vector2d center = Vector2d::Zero();  ///< [m]
  double radius = 0;                   ///< [m]
  double angular_speed = 1;            ///< w [rad/s]
  double phi = 0;                      ///< [rad]
};

/// Constant speed from one pose to another, and on at that speed.
struct Line {
  Pose from, to;
  double duration = 1;  ///< > 0 [s]
};

/// At rest in `from`, to rest in `to`, along s = 10 u^3 - 15 u^4 + 6 u^5 with u = t / duration:
/// velocity and acceleration vanish at both ends; before and after it stands still.
struct RestToRest {
  Pose from, to;
  double duration = 1;  ///< > 0 [s]
};

/// User points, joined by the cubic spline with continuous acceleration.
struct Spline {
  std::vector<double> times;      ///< strictly ascending [s]
  Eigen::MatrixX3d pose;          ///< time x (x, y [m], phi [rad])
  Eigen::MatrixX3d acceleration;  ///< at the points, from `make_spline`
};

/// natural: no acceleration at the ends; at_rest: no velocity; periodic: last pose = first pose.
enum class SplineEnds { natural, at_rest, periodic };

/// @throws ModelError  where there are fewer than three points, a number is not finite, the times
///                     do not ascend, or a periodic table does not end where it begins.
[[nodiscard]] Spline make_spline(const std::vector<double>& times, const std::vector<Pose>& poses,
                                 SplineEnds ends);

using Path = std::variant<Circle, Line, RestToRest, Spline>;

/// @throws ModelError  where the path has no meaning, or the time is outside a spline's.
[[nodiscard]] TrajectoryPoint at(const Path& path, double time);

/// The first and the last time at which there is a path; infinite but for a spline [s].
[[nodiscard]] std::pair<double, double> time_span(const Path& path);

/// Whether the platform never moves: not at any time, whatever the times that are looked at.
[[nodiscard]] bool stands_still(const Path& path);

/// The path at the times 0, step, 2 step, ... , (points - 1) step.
/// @throws ModelError  as `at`, or where points < 1 or the step is not positive.
[[nodiscard]] std::vector<TrajectoryPoint> sample(const Path& path, Index points, double step);

}  // namespace trammel::solver
