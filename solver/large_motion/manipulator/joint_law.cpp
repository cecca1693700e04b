#include "solver/large_motion/manipulator/joint_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <variant>

#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// How far a part has turned by a time [rad], and how fast [rad/s].
struct Turn {
  double time = 0, angle = 0, rate = 0;
};

TimeFunction extended(const TimeFunction& law, const Path& path) {
  return [law, limits = time_limits(path)](double t) {
    const double end = std::clamp(t, limits.first, limits.second), d = t - end;
    std::array<double, 3> motion = law(end);
    if (d == 0) return motion;
    const double a = motion[2], beyond = 2 * a - law(end - d)[2];
    return std::array<double, 3>{motion[0] + d * motion[1] + d * d * (2 * a + beyond) / 6,
                                 motion[1] + d * (a + beyond) / 2, beyond};
  };
}

}  // namespace

std::pair<double, double> time_limits(const Path& path) {
  const auto* spline = std::get_if<Spline>(&path);
  if (spline != nullptr) return {spline->times.front(), spline->times.back()};
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

RigidMotion once_per_time(std::function<InverseDynamics(double)> reckon) {
  struct Last {
    double time = kNaN;
    InverseDynamics motion;
  };
  return [reckon = std::move(reckon),
          last = std::make_shared<Last>()](double t) -> const InverseDynamics& {
    if (last->time != t) {
      last->motion = reckon(t);
      last->time = t;
    }
    return last->motion;
  };
}

TimeFunction joint_law(const RigidMotion& motion, const Path& path, double start, Index part,
                       Index from) {
  const auto seen = [part, from](const Vector9d& values) {
    return values[part] - (from < 0 ? 0.0 : values[from]);
  };
  const auto last = std::make_shared<Turn>(Turn{start, 0, seen(motion(start).q_dot)});
  const auto law = [motion, seen, before = seen(motion(start).q), last](double t) {
    constexpr double kSmall = 0.5;  // [rad]
    while (true) {
      const double left = t - last->time, limit = kSmall / std::abs(last->rate);
      double step = std::abs(left) > limit ? std::copysign(limit, left) : left;
      while (std::abs(seen(motion(last->time + step).q_dot) * step) > 2 * kSmall) step /= 2;
      const Turn next{step == left ? t : last->time + step, 0, 0};
      const InverseDynamics& now = motion(next.time);
      const double within = seen(now.q) - before, turns = 2 * std::numbers::pi;
      const double angle = within + turns * std::round((last->angle - within) / turns);
      const std::array<double, 3> found = {angle, seen(now.q_dot), seen(now.q_ddot)};
      const bool lost = !std::isfinite(angle + found[1]);  // out of reach, or singular
      if (lost || (next.time == last->time && next.time != t)) return found;
      *last = {next.time, angle, found[1]};
      if (next.time == t) return found;
    }
  };
  return extended(law, path);
}

}  // namespace trammel::solver::large_motion
