#include "solver/large_motion/manipulator/joint_law.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "solver/large_motion/solve/rigid_member_velocities.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// How far a part has turned by a time [rad], and how fast [rad/s].
struct Turn {
  double time = 0, angle = 0, rate = 0;
};

TimeFunction extended(const TimeFunction& law, const Path& path) {
  return [law, limits = time_span(path)](double t) {
    const double end = std::clamp(t, limits.first, limits.second), d = t - end;
    std::array<double, 3> motion = law(end);
    if (d == 0) return motion;
    const double a = motion[2], beyond = 2 * a - law(end - d)[2];
    return std::array<double, 3>{motion[0] + d * motion[1] + d * d * (2 * a + beyond) / 6,
                                 motion[1] + d * (a + beyond) / 2, beyond};
  };
}

}  // namespace

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

VectorXd nominal_rates(const GeometricallyExactSystem& system, const NominalMotion& motion,
                       int order, const std::vector<DrivenEnd>& ends) {
  const Model& model = system.model();
  const auto turn = [order](const PartMotion& part) {
    return order == 1 ? part.rate : part.acceleration;
  };
  const Index nodes = std::ssize(model.nodes), built = nodes - std::ssize(ends);
  Eigen::MatrixX3d node(nodes, 3);
  node.topLeftCorner(built, 2) = motion.node[to_size(order)].topRows(built);
  for (Index i = 0; i < built; ++i) node(i, 2) = turn(motion.at_node(i));
  for (const DrivenEnd& end : ends)
    node.row(end.node) << node.row(end.beside).head<2>(), turn(motion.part[end.member]);
  VectorXd member(std::ssize(model.members));
  for (Index m = 0; m < member.size(); ++m) member[m] = turn(motion.part[to_size(m)]);
  VectorXd rates = VectorXd::Zero(system.coordinates());
  for (const auto& [k, value] : rigid_member_velocities(system, node, member)) rates[k] = value;
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const PointMass& mass = model.masses[i];
    if (mass.offset.isZero(0)) continue;
    const Vector2d center = node.row(mass.node).head<2>().transpose() +
                            motion.at_node(mass.node).derivative(mass.offset, order);
    for (std::size_t k = 0; k < 2; ++k)
      rates[system.layout().mass_centre[i][k]] = center[static_cast<Index>(k)];
  }
  return rates;
}

}  // namespace trammel::solver::large_motion
