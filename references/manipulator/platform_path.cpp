#include "references/manipulator/programs.h"
#include "references/numerics/dense.h"

namespace trammel::references {

namespace {

using Motion = std::array<Jet<Real>, 3>;

Motion motion_on_circle(const Arguments& circle, const Jet<Real>& t) {
  const std::vector<Real> center = circle.numbers("center_m", 2);
  const Real radius = circle.positive("radius_m");
  const Jet<Real> s = circle.number("angular_speed_rad_s", 1) * t;
  return {center[0] + radius * cos(s), center[1] + radius * sin(s), circle.number("phi_rad", 0)};
}

std::array<Real, 3> pose(const Arguments& parent, const std::string& key) {
  const Arguments p(parent[key], parent.pointer(key), {"x_m", "y_m", "phi_rad"});
  return {p.number("x_m"), p.number("y_m"), p.number("phi_rad")};
}

Motion interpolate_poses(const Arguments& line, const Jet<Real>& share) {
  const auto from = pose(line, "from"), to = pose(line, "to");
  Motion motion;
  for (std::size_t c = 0; c < 3; ++c) motion[c] = from[c] + Real(to[c] - from[c]) * share;
  return motion;
}

Motion motion_from_rest_to_rest(const Arguments& line, const Jet<Real>& t) {
  const Jet<Real> u = t / line.positive("duration_s");
  if (!(u.value > 0)) return interpolate_poses(line, 0);
  if (!(u.value < 1)) return interpolate_poses(line, 1);
  return interpolate_poses(line, u * u * u * (Real(10) - Real(15) * u + Real(6) * u * u));
}

struct Knots {
  std::vector<Real> time;
  std::array<std::vector<Real>, 3> pose;
};

Knots read_knots(const Arguments& spline) {
  Knots knots;
  const Json& list = spline["knots"];
  if (!list.is_array() || list.size() < 3) spline.fail("knots", "expected at least three knots");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Arguments knot(list[k], spline.pointer("knots") + "/" + std::to_string(k),
                         {"time_s", "x_m", "y_m", "phi_rad"});
    knots.time.push_back(knot.number("time_s"));
    knots.pose[0].push_back(knot.number("x_m"));
    knots.pose[1].push_back(knot.number("y_m"));
    knots.pose[2].push_back(knot.number("phi_rad"));
    if (k > 0 && !(knots.time[k] > knots.time[k - 1]))
      spline.fail("knots", "expected ascending times");
  }
  return knots;
}

/// Returns the slopes of a cubic spline at its knots, for Hermite's form. The second derivative is
/// continuous at the inner knots, and `ends` prescribes a condition at both ends.
RealVector slopes(const std::vector<Real>& t, const std::vector<Real>& y, const std::string& ends) {
  const std::size_t n = t.size();
  RealMatrix A = RealMatrix::Zero(n, n);
  RealVector b = RealVector::Zero(n);
  const auto h = [&](std::size_t k) { return Real(t[k + 1] - t[k]); };
  const auto chord_slope = [&](std::size_t k) { return Real((y[k + 1] - y[k]) / h(k)); };
  // Sets an equation of the slopes: the second derivatives at the end of interval `k` and at the
  // start of interval `l` are equal.
  const auto smooth = [&](std::size_t row, std::size_t k, std::size_t l) {
    A(row, k) += 2 / h(k);
    A(row, k + 1) += 4 / h(k);
    A(row, l) += 4 / h(l);
    A(row, l + 1) += 2 / h(l);
    b[row] = 6 * chord_slope(k) / h(k) + 6 * chord_slope(l) / h(l);
  };
  for (std::size_t k = 1; k + 1 < n; ++k) smooth(k, k - 1, k);
  if (ends == "natural") {
    A(0, 0) = 2;
    A(0, 1) = 1;
    b[0] = 3 * chord_slope(0);
    A(n - 1, n - 2) = 1;
    A(n - 1, n - 1) = 2;
    b[n - 1] = 3 * chord_slope(n - 2);
  } else if (ends == "at-rest") {
    A(0, 0) = A(n - 1, n - 1) = 1;
  } else {
    smooth(0, n - 2, 0);
    A(n - 1, 0) = 1;
    A(n - 1, n - 1) = -1;
  }
  return solve(A, b, "the conditions of the spline are singular");
}

Motion motion_on_spline(const Arguments& spline, const Jet<Real>& t) {
  const Knots knots = read_knots(spline);
  const std::string ends = spline.choice("ends", "natural", {"natural", "at-rest", "periodic"});
  std::size_t k = 0;
  while (k + 2 < knots.time.size() && !(t.value < knots.time[k + 1])) ++k;
  const Real h = knots.time[k + 1] - knots.time[k];
  const Jet<Real> u = (t - knots.time[k]) / h;
  const Jet<Real> v = Real(1) - u;
  Motion motion;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<Real>& y = knots.pose[c];
    const RealVector s = slopes(knots.time, y, ends);
    motion[c] = y[k] * v * v * (Real(1) + Real(2) * u) +
                y[k + 1] * u * u * (Real(3) - Real(2) * u) +
                h * (s[k] * u * v * v - s[k + 1] * u * u * v);
  }
  return motion;
}

}  // namespace

Motion platform_motion(const Arguments& trajectory, const Real& time) {
  const Jet<Real> t(time, 1, 0);
  const auto section = [&](const char* key, const std::vector<std::string>& known) {
    return Arguments(trajectory[key], trajectory.pointer(key), known);
  };
  if (trajectory.has("circle"))
    return motion_on_circle(
        section("circle", {"center_m", "radius_m", "angular_speed_rad_s", "phi_rad"}), t);
  if (trajectory.has("line")) {
    const Arguments line = section("line", {"from", "to", "duration_s"});
    return interpolate_poses(line, t / line.positive("duration_s"));
  }
  if (trajectory.has("rest_to_rest"))
    return motion_from_rest_to_rest(section("rest_to_rest", {"from", "to", "duration_s"}), t);
  return motion_on_spline(section("spline", {"knots", "ends"}), t);
}

}  // namespace trammel::references
