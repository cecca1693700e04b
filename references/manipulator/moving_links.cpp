#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "references/manipulator/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

/// Vibration of a planar 3-RRR with links that have mass and next to no stiffness, each one cubic
/// element of a Timoshenko beam that is hinged at its elbow and at the platform, about its motion
/// along a path. Written in the axes of each link, which turn at W: with the interpolation N of
/// what its nodes do in these axes, x, and Q = diag(rho A, rho A, rho I) along the link,
///   int N^T Q (N x.. + 2 W J N x. + (W. J - W^2 P) N x + r..) ds,
/// J a quarter turn and P the identity of translations; r.. of the nominal motion. Damped by b M,
/// on all of the velocities in world axes. By Fehlberg's method of order 8.
namespace trammel::references {

namespace {

/// u_x, u_y, theta of P; then of each limb u_x, u_y of B and the rotations of the proximal link's
/// end, of the distal link's start and of its end.
constexpr std::size_t kCoordinates = 18, kOfPlatform = 3, kOfLimb = 5;
using Coordinates = Eigen::Matrix<Real, kCoordinates, 1>;
using SystemState = std::array<Real, 2 * kCoordinates>;
using Six = Eigen::Matrix<Real, 6, 1>;

struct SystemMotion {
  Coordinates q = Coordinates::Zero(), v = q, a = q;
};

/// What the nodes of a link do, in world axes; `damped` are velocities that are damped.
struct LinkMotion {
  Six u = Six::Zero(), v = u, a = u, damped = u;
};

struct Turn {
  Real cosine, sine, rate, acceleration;
};

/// Translations turned by an angle; `rotations` says whether the rotations stay or go.
Six turned_nodes(const Six& x, const Real& c, const Real& s, int rotations) {
  return {c * x[0] - s * x[1], s * x[0] + c * x[1], rotations * x[2],
          c * x[3] - s * x[4], s * x[3] + c * x[4], rotations * x[5]};
}

/// A Timoshenko beam's cubic between its nodes, rows u, v, rotation (Friedman and Kosmatka 1993).
std::array<Six, 3> interpolation(const Real& x, const Real& length, const Real& phi) {
  const Real g = 1 / (1 + phi), y = 1 - x;
  const auto lift = [&](const Real& z) {  // v by v of the end at z = 0
    return Real(g * (1 - 3 * z * z + 2 * z * z * z + phi * (1 - z)));
  };
  const auto swing = [&](const Real& z) {  // v by the rotation there
    return Real(g * length * z * (1 - z) * (1 - z + phi / 2));
  };
  const auto tilt = [&](const Real& z) { return Real(g * (1 - z) * (1 - 3 * z + phi)); };
  const Real shear = 6 * g * x * y / length;
  return {{{y, 0, 0, x, 0, 0},
           {0, lift(x), swing(x), 0, lift(y), -swing(y)},
           {0, -shear, tilt(x), 0, shear, tilt(y)}}};
}

/// int N^T Q N, int N^T Q J N and int N^T Q P N of one link in its axes.
struct LinkInertia {
  explicit LinkInertia(const LinkNumbers& link) {
    matrix.fill(Eigen::Matrix<Real, 6, 6>::Zero());
    const FrameSection& section = link.section;
    const Real phi = 12 * section.EI * section.shear_compliance / (link.length * link.length);
    constexpr std::array<int, 7> kWeights = {41, 216, 27, 272, 27, 216, 41};  // Newton and Cotes
    for (int p = 0; p < 7; ++p) {
      const Real weight = link.length * kWeights[static_cast<std::size_t>(p)] / 840;
      const auto N = interpolation(Real(p) / 6, link.length, phi);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
          const Real along = weight * section.mass * (N[0][i] * N[0][j] + N[1][i] * N[1][j]);
          matrix[0](i, j) += along + weight * section.rotary_inertia * N[2][i] * N[2][j];
          matrix[1](i, j) += weight * section.mass * (N[1][i] * N[0][j] - N[0][i] * N[1][j]);
          matrix[2](i, j) += along;
        }
      }
    }
  }

  /// Forces of inertia at the nodes, in world axes.
  [[nodiscard]] Six force(const Turn& turn, const LinkMotion& m) const {
    const Real W = turn.rate;
    const auto in_axes = [&](const Six& x) { return turned_nodes(x, turn.cosine, -turn.sine, 1); };
    const auto quarter = [&](const Six& x) { return turned_nodes(x, 0, 1, 0); };
    const Six u = in_axes(m.u), v = in_axes(m.v);
    const Six Ju = quarter(u);
    const Six x_dot = v - W * Ju;
    const Six x_ddot = in_axes(m.a) + in_axes(m.damped) - Real(2 * W) * quarter(v) -
                       turn.acceleration * Ju + Real(W * W) * quarter(Ju);
    const Six f = matrix[0] * x_ddot + matrix[1] * (Real(2 * W) * x_dot + turn.acceleration * u) -
                  Real(W * W) * (matrix[2] * u);
    return turned_nodes(f, turn.cosine, turn.sine, 1);
  }

  std::array<Eigen::Matrix<Real, 6, 6>, 3> matrix;
};

/// What the nominal motion is at one time.
struct Nominal {
  std::array<Jet<Real>, 3> pose;
  std::array<std::array<Point2<Jet<Real>>, 3>, 3> joints;  ///< A, B, C of each limb
};

class Links {
 public:
  explicit Links(const Arguments& arguments)
      : numbers_(read_planar_manipulator(arguments)),
        trajectory_(read_trajectory(arguments)),
        wrench_(read_wrench(arguments)),
        damping_(arguments.number("mass_damping_per_s", 0)) {
    for (const LimbNumbers& limb : numbers_.limbs)
      inertia_.push_back({LinkInertia(limb.proximal), LinkInertia(limb.distal)});
  }

  [[nodiscard]] Nominal nominal(const Real& t) const {
    Nominal now{platform_motion(trajectory_, t), {}};
    for (std::size_t i = 0; i < 3; ++i) now.joints[i] = limb_joints(numbers_.limbs[i], now.pose);
    return now;
  }

  /// Forces of inertia and damping less loads, on each coordinate; of the nominal motion, too, or
  /// of accelerations alone. @param torques  of the base on the proximal links
  [[nodiscard]] Coordinates residual(const Nominal& now, const SystemMotion& motion, bool nominal,
                                     std::array<Real, 3>* torques = nullptr) const {
    Coordinates r = platform_residual(now, motion, nominal);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t at = kOfPlatform + kOfLimb * i;
      const LinkMotion proximal = proximal_motion(now, motion, i, nominal);
      const Six f = inertia_[i][0].force(turn_of(now.joints[i][0], now.joints[i][1]), proximal);
      const LinkMotion distal = distal_motion(now, motion, i, nominal);
      const Six g = inertia_[i][1].force(turn_of(now.joints[i][1], now.joints[i][2]), distal);
      const Point2<Real> arm = corner_arm(now, i);
      r[at] = f[3] + g[0];
      r[at + 1] = f[4] + g[1];
      r[at + 2] = f[5];
      r[at + 3] = g[2];
      r[at + 4] = g[5];
      r[0] += g[3];
      r[1] += g[4];
      r[2] += arm[0] * g[4] - arm[1] * g[3];
      if (torques != nullptr) (*torques)[i] = f[2];
    }
    return r;
  }

  [[nodiscard]] SystemMotion solved(const SystemState& x, const Real& t) const {
    const Nominal now = nominal(t);
    SystemMotion motion;
    std::copy_n(x.begin(), kCoordinates, motion.q.begin());
    std::copy_n(x.begin() + kCoordinates, kCoordinates, motion.v.begin());
    const Coordinates r = residual(now, motion, true);
    RealMatrix M(kCoordinates, kCoordinates);
    for (std::size_t j = 0; j < kCoordinates; ++j) {
      SystemMotion unit;
      unit.a[j] = 1;
      M.col(j) = residual(now, unit, false);
    }
    motion.a = -solve(M, r, "a link has no mass");
    return motion;
  }

  [[nodiscard]] Real output(const std::string& name, const SystemState& x, const Real& t) const {
    if (name == "platform_rotation_rad") return x[2];
    const auto limb = static_cast<std::size_t>(name.back() - '1');
    if (name[0] == 't') {
      std::array<Real, 3> torques;
      static_cast<void>(residual(nominal(t), solved(x, t), true, &torques));
      return torques[limb];
    }
    const std::size_t component = name.find("_y_") == std::string::npos ? 0 : 1;
    return x[(name.back() == 'P' ? 0 : kOfPlatform + kOfLimb * limb) + component];
  }

 private:
  static Turn turn_of(const Point2<Jet<Real>>& from, const Point2<Jet<Real>>& to) {
    const Jet<Real> x = to[0] - from[0], y = to[1] - from[1];
    const Real square = x.value * x.value + y.value * y.value, length = sqrt(square);
    return {x.value / length, y.value / length, (x.value * y.rate - y.value * x.rate) / square,
            (x.value * y.acceleration - y.value * x.acceleration) / square};
  }

  static Point2<Real> corner_arm(const Nominal& now, std::size_t i) {
    const auto& C = now.joints[i][2];
    return {C[0].value - now.pose[0].value, C[1].value - now.pose[1].value};
  }

  [[nodiscard]] LinkMotion proximal_motion(const Nominal& now, const SystemMotion& m, std::size_t i,
                                           bool nominal) const {
    const auto& [A, B, C] = now.joints[i];
    const std::size_t at = kOfPlatform + kOfLimb * i;
    const auto end = [at](const Coordinates& x) {
      return Six{0, 0, 0, x[at], x[at + 1], x[at + 2]};
    };
    LinkMotion link{end(m.q), end(m.v), end(m.a), Six::Zero()};
    link.damped = damping_ * link.v;
    if (!nominal) return link;
    const Real turning = turn_of(A, B).acceleration;
    link.a += Six{0, 0, turning, B[0].acceleration, B[1].acceleration, turning};
    return link;
  }

  [[nodiscard]] LinkMotion distal_motion(const Nominal& now, const SystemMotion& m, std::size_t i,
                                         bool nominal) const {
    const auto& [A, B, C] = now.joints[i];
    const std::size_t at = kOfPlatform + kOfLimb * i;
    const Point2<Real> arm = corner_arm(now, i);
    // theta J arm, with the rates of the arm, which turns with the platform.
    const auto ends = [&](const Coordinates& x, const Real& along, const Real& across) {
      return Six{x[at],
                 x[at + 1],
                 x[at + 3],
                 x[0] + along * arm[0] - across * arm[1],
                 x[1] + along * arm[1] + across * arm[0],
                 x[at + 4]};
    };
    const Real w = now.pose[2].rate, w_dot = now.pose[2].acceleration;
    LinkMotion link;
    link.u = ends(m.q, 0, m.q[2]);
    link.v = ends(m.v, -w * m.q[2], m.v[2]);
    link.a = ends(m.a, -2 * w * m.v[2] - w_dot * m.q[2], m.a[2] - w * w * m.q[2]);
    link.damped = damping_ * link.v;
    if (!nominal) return link;
    const Real turning = turn_of(B, C).acceleration;
    link.a += Six{B[0].acceleration, B[1].acceleration, turning,
                  C[0].acceleration, C[1].acceleration, turning};
    return link;
  }

  /// As in moving_platform.cpp: a mass at s from P.
  [[nodiscard]] Coordinates platform_residual(const Nominal& now, const SystemMotion& x,
                                              bool nominal) const {
    const Real m = numbers_.platform_mass, J = numbers_.platform_inertia;
    const Real c = cos(now.pose[2].value), n = sin(now.pose[2].value);
    const Real w = now.pose[2].rate, w_dot = now.pose[2].acceleration;
    const Point2<Real>& s0 = numbers_.platform_center;
    const Point2<Real> s = {c * s0[0] - n * s0[1], n * s0[0] + c * s0[1]};
    const Real along = -2 * w * x.v[2] - w_dot * x.q[2] - (nominal ? w * w : Real(0));
    const Real across = x.a[2] + damping_ * x.v[2] - w * w * x.q[2] + (nominal ? w_dot : Real(0));
    Point2<Real> f = {x.a[0] + damping_ * x.v[0] + along * s[0] - across * s[1],
                      x.a[1] + damping_ * x.v[1] + along * s[1] + across * s[0]};
    for (std::size_t k = 0; k < 2; ++k) {
      f[k] *= m;
      if (nominal) f[k] += m * now.pose[k].acceleration;
    }
    Coordinates r = Coordinates::Zero();
    r[2] = s[0] * f[1] - s[1] * f[0] + J * (x.a[2] + damping_ * x.v[2]);
    r[0] = f[0];
    r[1] = f[1];
    if (!nominal) return r;
    r[2] += J * w_dot - wrench_.moment;
    r[0] -= wrench_.x;
    r[1] -= wrench_.y;
    return r;
  }

  ManipulatorNumbers numbers_;
  Arguments trajectory_;
  PlanarWrench wrench_;
  Real damping_;
  std::vector<std::array<LinkInertia, 2>> inertia_;
};

/// States at the times; of a turn of some 1 rad a dozen steps of order 8 leave 1e-13.
std::vector<SystemState> states(const Links& links, const std::vector<Real>& times) {
  constexpr int kSteps = 4;  // from time to time
  boost::numeric::odeint::runge_kutta_fehlberg78<SystemState, Real, SystemState, Real> stepper;
  const auto rate = [&](const SystemState& x, SystemState& dx, const Real& t) {
    const SystemMotion motion = links.solved(x, t);
    std::ranges::copy(motion.v, dx.begin());
    std::ranges::copy(motion.a, dx.begin() + kCoordinates);
  };
  SystemState x{};
  std::vector<SystemState> found = {x};
  for (std::size_t k = 1; k < times.size(); ++k) {
    const Real h = (times[k] - times[k - 1]) / kSteps;
    for (int i = 0; i < kSteps; ++i) stepper.do_step(rate, x, Real(times[k - 1] + i * h), h);
    found.push_back(x);
  }
  return found;
}

}  // namespace

std::vector<double> moving_links_program(const Json& json) {
  const Arguments arguments(json, "",
                            {"manipulator", "trajectory", "force_N", "moment_N_m",
                             "mass_damping_per_s", "times_s", "outputs"});
  const Links links(arguments);
  const std::vector<Real> times = arguments.numbers("times_s");
  if (!std::ranges::is_sorted(times)) arguments.fail("times_s", "times that ascend");
  const std::vector<SystemState> state = states(links, times);
  std::vector<Real> values;
  for (const std::string& name : arguments.texts("outputs")) {
    for (std::size_t k = 0; k < times.size(); ++k)
      values.push_back(links.output(name, state[k], times[k]));
  }
  return to_doubles(values);
}

}  // namespace trammel::references
