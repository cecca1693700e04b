#include <algorithm>
#include <array>

#include "references/manipulator/programs.h"
#include "references/numerics/integration.h"
#include "references/numerics/real.h"

/// Vibration of the platform of a planar 3-RRR about its motion along a path, on links without
/// mass, with distal links hinged at both ends. Each limb is a bar, elastic along B C, with 1/k =
/// l_d/EA + l_p cos^2 b/EA + (l_p^3/(3 EI) + l_p/(kappa G A)) sin^2 b, where b is the angle between
/// the links. The platform has three coordinates about P, q = (u_x, u_y, theta), in world axes.
/// With the center of mass at s from P, e the axis of rotation, and W q = u + theta e x s its
/// displacement,
///   m W^T (W q.. + 2 W. q. + W.. q + r..) + J e (theta.. + phi..) + K(t) q = h(t) F,
/// where r.. is the acceleration of the center of mass in the nominal motion. The paper omits W.
/// and W.. (`rate_terms` false). The equations are integrated by Fehlberg's method of order 8 in
/// steps of 0.25 ms.
namespace trammel::references {

namespace {

using State = std::array<Real, 6>;  // u_x, u_y, theta and their rates
using Three = std::array<Real, 3>;
using Matrix3 = std::array<Three, 3>;

/// A limb at one pose: what q stretches it by, its stiffness, the lever of its tension about A.
struct Limb {
  Three stretch;
  Real stiffness, lever;
};

class Platform {
 public:
  explicit Platform(const Arguments& arguments)
      : numbers_(read_planar_manipulator(arguments)),
        trajectory_(read_trajectory(arguments)),
        wrench_(read_wrench(arguments)),
        rates_(arguments.flag("rate_terms", false)) {}

  [[nodiscard]] Limb limb(std::size_t i, const Real& t) const {
    const auto pose = platform_motion(trajectory_, t);
    const LimbNumbers& numbers = numbers_.limbs[i];
    const Point2<Real> arm = turned(numbers.corner, pose[2].value);
    const Point2<Real> C = {pose[0].value + arm[0], pose[1].value + arm[1]};
    const Real l = numbers.proximal.length, d = numbers.distal.length;
    const Point2<Real> B = elbow(numbers.base, C, l, d, numbers.mode);
    const Point2<Real> along = {(C[0] - B[0]) / d, (C[1] - B[1]) / d};
    const Point2<Real> link = {B[0] - numbers.base[0], B[1] - numbers.base[1]};
    const Real cosine = (link[0] * along[0] + link[1] * along[1]) / l;
    const Real lever = link[0] * along[1] - link[1] * along[0];
    const FrameSection &p = numbers.proximal.section, &q = numbers.distal.section;
    const Real compliance = d * q.axial_compliance + l * cosine * cosine * p.axial_compliance +
                            lever * lever * (l / (3 * p.EI) + p.shear_compliance / l);
    return {{along[0], along[1], arm[0] * along[1] - arm[1] * along[0]}, 1 / compliance, lever};
  }

  /// @param factor  on the wrench at t
  void rate(const State& x, State& dx, const Real& t, const Real& factor) const {
    const auto pose = platform_motion(trajectory_, t);
    const Real phi = pose[2].value, w = pose[2].rate, w_dot = pose[2].acceleration;
    const Point2<Real> s = turned(numbers_.platform_center, phi);
    const Real m = numbers_.platform_mass, J = numbers_.platform_inertia;
    // W theta = (-s_y, s_x) theta; its first and second derivatives.
    const Point2<Real> first = {-w * s[0], -w * s[1]};
    const Point2<Real> second = {-w_dot * s[0] + w * w * s[1], -w_dot * s[1] - w * w * s[0]};
    Point2<Real> force;
    for (std::size_t c = 0; c < 2; ++c) {
      const Real turning = c == 0 ? -s[1] : s[0];
      force[c] = -m * (pose[c].acceleration + w_dot * turning - w * w * s[c]);
      if (rates_) force[c] -= m * (2 * first[c] * x[5] + second[c] * x[2]);
    }
    Three f = {force[0] + factor * wrench_.x, force[1] + factor * wrench_.y,
               s[0] * force[1] - s[1] * force[0] - J * w_dot + factor * wrench_.moment};
    for (std::size_t i = 0; i < 3; ++i) {
      const Limb one = limb(i, t);
      const Real tension = one.stiffness * stretch(one, x);
      for (std::size_t c = 0; c < 3; ++c) f[c] -= tension * one.stretch[c];
    }
    // M = [m, -m s_y; m, m s_x; J + m s^2]: from the moment about the center of mass.
    const Real turn = (f[2] - (s[0] * f[1] - s[1] * f[0])) / J;
    dx = {x[3], x[4], x[5], f[0] / m + s[1] * turn, f[1] / m - s[0] * turn, turn};
  }

  [[nodiscard]] static Real stretch(const Limb& limb, const State& x) {
    return limb.stretch[0] * x[0] + limb.stretch[1] * x[1] + limb.stretch[2] * x[2];
  }

  [[nodiscard]] Real output(const std::string& name, const State& x, const Real& t) const {
    if (name == "displacement_x_m") return x[0];
    if (name == "displacement_y_m") return x[1];
    if (name == "platform_rotation_rad") return x[2];
    if (name == "kinetic_energy_J") {
      const Point2<Real> s =
          turned(numbers_.platform_center, platform_motion(trajectory_, t)[2].value);
      const Real u = x[3] - s[1] * x[5], v = x[4] + s[0] * x[5];
      return (numbers_.platform_mass * (u * u + v * v) + numbers_.platform_inertia * x[5] * x[5]) /
             2;
    }
    const Limb one = limb(static_cast<std::size_t>(name.back() - '1'), t);
    const Real tension = one.stiffness * stretch(one, x);
    return name[0] == 't' ? Real(-tension * one.lever) : tension;
  }

 private:
  [[nodiscard]] static Point2<Real> turned(const Point2<Real>& a, const Real& phi) {
    return {cos(phi) * a[0] - sin(phi) * a[1], sin(phi) * a[0] + cos(phi) * a[1]};
  }

  ManipulatorNumbers numbers_;
  Arguments trajectory_;
  PlanarWrench wrench_;
  bool rates_;
};

struct History {
  std::vector<Real> time, factor;

  /// By the straight line on which the factor lies at `within`.
  [[nodiscard]] Real at(const Real& t, const Real& within) const {
    const auto next = std::ranges::upper_bound(time, within);
    if (next == time.begin()) return factor.front();
    if (next == time.end()) return factor.back();
    const auto k = static_cast<std::size_t>(next - time.begin());
    return factor[k - 1] +
           (factor[k] - factor[k - 1]) * (t - time[k - 1]) / (time[k] - time[k - 1]);
  }
};

void advance(const Platform& platform, const History& history, const Real& from, const Real& to,
             State& x) {
  const Real within = (from + to) / 2;
  const auto rate = [&](const State& now, State& dx, const Real& t) {
    platform.rate(now, dx, t, history.at(t, within));
  };
  integrate(rate, x, from, to, static_cast<int>(ceil((to - from) * 4000)));
}

}  // namespace

std::vector<Real> moving_platform_program(const Arguments& arguments) {
  const Platform platform(arguments);
  History history{{Real(0)}, {Real(1)}};
  if (arguments.has("load_history")) {
    const Arguments given(arguments["load_history"], "/load_history", {"time_s", "factor"});
    history.time = given.numbers("time_s");
    history.factor = given.numbers("factor", history.time.size());
  }
  const std::vector<Real> times = arguments.numbers("times_s");
  if (!std::ranges::is_sorted(times)) arguments.fail("times_s", "times that ascend");
  State x{};
  Real now = times.front();
  std::vector<Real> values;
  for (const Real& t : times) {
    for (const Real& corner : history.time) {
      if (!(corner > now && corner < t)) continue;
      advance(platform, history, now, corner, x);
      now = corner;
    }
    if (t > now) advance(platform, history, now, t, x);
    now = t;
    values.push_back(platform.output(arguments.text("output"), x, t));
  }
  return values;
}

}  // namespace trammel::references
