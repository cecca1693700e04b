#include "solver/manipulator/trajectory.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/linalg/factorization.h"

namespace trammel::solver {

namespace {

void require_path(bool holds, const char* message) {
  if (!holds) throw PathError(message);
}

TrajectoryPoint evaluate(const Circle& circle, double t) {
  require_path(circle.center.allFinite() && std::isfinite(circle.phi), "the circle is not finite");
  require_path(circle.radius >= 0 && std::isfinite(circle.radius),
               "the circle's radius must not be negative");
  require_path(std::isfinite(circle.angular_speed), "the circle's angular speed is not finite");
  const double w = circle.angular_speed;
  const double rx = circle.radius * std::cos(w * t);
  const double ry = circle.radius * std::sin(w * t);
  return {0,
          {circle.center.x() + rx, circle.center.y() + ry, circle.phi},
          {-w * ry, w * rx, 0},
          {-w * w * rx, -w * w * ry, 0}};
}

/// Returns the pose from + s (to - from) with its velocity and acceleration. `ds` and `dds` are the
/// first and second time derivatives of s.
TrajectoryPoint between(const Pose& from, const Pose& to, double s, double ds, double dds) {
  const Vector3d line = to.vector() - from.vector();
  require_path(line.allFinite(), "the start or end pose of the path is not finite");
  return {0, pose_of(from.vector() + s * line), ds * line, dds * line};
}

TrajectoryPoint evaluate(const Line& line, double t) {
  require_path(line.duration > 0 && std::isfinite(line.duration),
               "the line's duration must be positive");
  return between(line.from, line.to, t / line.duration, 1 / line.duration, 0);
}

TrajectoryPoint evaluate(const RestToRest& path, double t) {
  const double T = path.duration;
  require_path(T > 0 && std::isfinite(T), "the duration of the motion must be positive");
  const double u = std::clamp(t / T, 0.0, 1.0);
  const double v = 1 - u;
  return between(path.from, path.to, u * u * u * (10 + u * (-15 + 6 * u)), 30 * u * u * v * v / T,
                 60 * u * v * (v - u) / (T * T));
}

TrajectoryPoint evaluate(const Spline& spline, double time) {
  const auto& times = spline.times;
  require_path(times.size() >= 2, "a table of poses requires at least three points");
  // A multiple of a step may exceed the end time by round-off: 63 steps of 0.1 s exceed 6.3 s.
  const double rounding = 4 * std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(times.front()), std::abs(times.back()));
  require_path(time >= times.front() - rounding && time <= times.back() + rounding,
               "the time is outside the range of the table of poses");
  const double t = std::clamp(time, times.front(), times.back());
  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, t);
  const auto k = static_cast<Index>(next - times.begin());
  const double h = *next - *(next - 1);
  const double b = (t - *(next - 1)) / h;
  const double a = (*next - t) / h;
  const Vector3d p0 = spline.pose.row(k - 1), p1 = spline.pose.row(k);
  const Vector3d a0 = spline.acceleration.row(k - 1);
  const Vector3d a1 = spline.acceleration.row(k);
  return {0, pose_of(a * p0 + b * p1 + (h * h / 6) * (a * (a * a - 1) * a0 + b * (b * b - 1) * a1)),
          (p1 - p0) / h + (h / 6) * ((1 - 3 * a * a) * a0 + (3 * b * b - 1) * a1), a * a0 + b * a1};
}

bool is_still_path(const Circle& circle) {
  return circle.radius == 0 || circle.angular_speed == 0;
}

bool is_still_path(const Spline& spline) {
  return (spline.pose.rowwise() - spline.pose.row(0)).isZero(0);
}

/// Returns true if a line or a rest-to-rest motion ends at the pose at which it starts.
template <class Way>
bool is_still_path(const Way& line) {
  return line.from.vector() == line.to.vector();
}

}  // namespace

// Computes a cubic spline. Unknowns are the accelerations a_k at the times t_k of the given poses.
// The time intervals are h_k = t_{k+1} - t_k, and slope_k is the difference of the poses k + 1 and
// k divided by h_k. Velocities are continuous if
//
//   h_{k-1} a_{k-1} + 2 (h_{k-1} + h_k) a_k + h_k a_{k+1} = 6 (slope_k - slope_{k-1}).
Spline make_spline(const std::vector<double>& times, const std::vector<Pose>& poses,
                   SplineEnds ends) {
  const auto n = static_cast<Index>(times.size());
  require_path(n >= 3, "a table of poses requires at least three points");
  require_path(poses.size() == times.size(), "a table of poses requires one time for each pose");
  Spline spline{times, Eigen::MatrixX3d(n, 3), Eigen::MatrixX3d::Zero(n, 3)};
  for (Index k = 0; k < n; ++k) spline.pose.row(k) = poses[to_size(k)].vector();
  const Eigen::Map<const Eigen::VectorXd> knots(times.data(), n);
  const Eigen::VectorXd h = knots.tail(n - 1) - knots.head(n - 1);
  require_path(spline.pose.allFinite() && knots.allFinite(), "the table of poses is not finite");
  for (Index k = 0; k + 1 < n; ++k) {
    if (h(k) > 0) continue;
    throw PathError("the times of a table of poses must ascend; knot " + std::to_string(k + 1) +
                    " at " + std::to_string(knots[k + 1]) + " s does not follow " +
                    std::to_string(knots[k]) + " s");
  }
  const bool periodic = ends == SplineEnds::periodic;
  require_path(!periodic || spline.pose.row(0) == spline.pose.row(n - 1),
               "a periodic table of poses must end where it begins");

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d rhs = Eigen::MatrixX3d::Zero(n, 3);
  const auto slope = [&](Index k) -> Eigen::RowVector3d {
    return (spline.pose.row(k + 1) - spline.pose.row(k)) / h(k);
  };
  const auto bend = [&](Index row, Index before, Index after, Index next) {
    entries.emplace_back(row, before, h(before));
    entries.emplace_back(row, row, 2 * (h(before) + h(after)));
    entries.emplace_back(row, next, h(after));
    rhs.row(row) = 6 * (slope(after) - slope(before));
  };
  for (Index k = 1; k + 1 < n; ++k) bend(k, k - 1, k, k + 1);
  if (periodic) {
    bend(0, n - 2, 0, 1);
    entries.emplace_back(n - 1, n - 1, 1);
    entries.emplace_back(n - 1, 0, -1);
  } else {
    entries.emplace_back(0, 0, 2 * h(0));
    entries.emplace_back(n - 1, n - 1, 2 * h(n - 2));
  }
  if (ends == SplineEnds::at_rest) {
    entries.emplace_back(0, 1, h(0));
    rhs.row(0) = 6 * slope(0);
    entries.emplace_back(n - 1, n - 2, h(n - 2));
    rhs.row(n - 1) = -6 * slope(n - 2);
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  SparseLu<double> lu;
  require_path(lu.factorize(A), "the equations of the spline through the table are singular");
  for (Index c = 0; c < 3; ++c) spline.acceleration.col(c) = lu.solve(rhs.col(c));
  return spline;
}

TrajectoryPoint at(const Path& path, double time) {
  require_path(std::isfinite(time), "the time is not finite");
  TrajectoryPoint point = std::visit([&](const auto& p) { return evaluate(p, time); }, path);
  point.time = time;
  return point;
}

std::pair<double, double> time_span(const Path& path) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  const auto* spline = std::get_if<Spline>(&path);
  if (spline == nullptr) return {-kEver, kEver};
  return {spline->times.front(), spline->times.back()};
}

bool is_at_rest(const Path& path) {
  return std::visit([](const auto& p) { return is_still_path(p); }, path);
}

std::vector<TrajectoryPoint> sample(const Path& path, Index points, double step) {
  require_path(points >= 1, "a trajectory requires at least one point");
  require_path(step > 0 && std::isfinite(step), "the time step of a trajectory must be positive");
  std::vector<TrajectoryPoint> result;
  result.reserve(static_cast<std::size_t>(points));
  for (Index k = 0; k < points; ++k) result.push_back(at(path, static_cast<double>(k) * step));
  return result;
}

}  // namespace trammel::solver
