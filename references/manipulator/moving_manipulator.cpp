#include <algorithm>
#include <array>

#include "references/manipulator/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/integration.h"

namespace trammel::references {

namespace {

/// Vibration of the platform of a planar 3-RRR manipulator about its motion along a path. The links
/// have no mass, and the distal links are hinged at both ends. Each limb acts on the platform like
/// a bar from the elbow B to the platform joint C with the stiffness k. With the lengths l_p and
/// l_d of the proximal and distal link, and the angle b between the links:
///
///   1/k = l_d/EA + l_p cos^2 b/EA + (l_p^3/(3 EI) + l_p/(kappa G A)) sin^2 b.
///
/// The platform has three coordinates about P, q = (u_x, u_y, theta), in world axes, the mass m,
/// and the moment of inertia J about its center of mass. The vector s points from P to the center
/// of mass, and e is the axis of rotation. The center of mass moves by W q = u + theta e x s. The
/// load F acts at P with the factor h(t). The equations of motion are
///
///   m W^T (W q.. + 2 W. q. + W.. q + r..) + J e (theta.. + phi..) + K(t) q = h(t) F.
///
/// Dots are time derivatives. In the nominal motion, r.. is the acceleration of the center of mass
/// and phi.. the angular acceleration of the platform. Varalakshmi and Srinivas (2017) omit W. and
/// W.. (`rate_terms` false). The equations are integrated by Fehlberg's method of order 8 in steps
/// of 0.25 ms.
using State = std::array<Real, 6>;  // u_x, u_y, theta and their rates
using Three = std::array<Real, 3>;

/// Data of a limb at one pose: derivative of its elongation with respect to q, stiffness k, and
/// lever arm of its axial force about A.
struct Limb {
  Three stretch;
  Real stiffness, lever;
};

class Platform {
 public:
  explicit Platform(const Arguments& arguments)
      : numbers_(read_planar_manipulator(arguments)),
        trajectory_(trajectory_arguments(arguments)),
        wrench_(read_wrench(arguments)),
        rates_(arguments.flag("rate_terms", false)) {}

  [[nodiscard]] Limb limb(std::size_t i, const Real& t) const {
    const auto pose = platform_motion(trajectory_, t);
    const LimbNumbers& numbers = numbers_.limbs[i];
    const Point2<Real> arm = rotated(numbers.corner, pose[2].value);
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

  /// Computes the derivative dx of the state x at the time t.
  /// @param factor  load factor h(t), which multiplies the load on the platform
  void rate(const State& x, State& dx, const Real& t, const Real& factor) const {
    const auto pose = platform_motion(trajectory_, t);
    const Real m = numbers_.platform_mass, J = numbers_.platform_inertia;
    const PointJet arm = rotated(numbers_.platform_center, pose[2]);
    const Point2<Real> s = {arm[0].value, arm[1].value};
    const Jet<Real> theta = rates_ ? Jet<Real>(x[2], x[5], 0) : Jet<Real>();
    const Real fx = -m * (pose[0] + arm[0] - arm[1] * theta).acceleration;
    const Real fy = -m * (pose[1] + arm[1] + arm[0] * theta).acceleration;
    Three f = {fx + factor * wrench_.x, fy + factor * wrench_.y,
               s[0] * fy - s[1] * fx - J * pose[2].acceleration + factor * wrench_.moment};
    for (std::size_t i = 0; i < 3; ++i) {
      const Limb one = limb(i, t);
      const Real tension = one.stiffness * stretch(one, x);
      for (std::size_t c = 0; c < 3; ++c) f[c] -= tension * one.stretch[c];
    }
    // Solves the equations of motion. Their mass matrix has the entries m, -m s_y, m s_x and J + m
    // s^2. The moment balance about the center of mass therefore contains only the angular
    // acceleration.
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
      const auto s = rotated(numbers_.platform_center, platform_motion(trajectory_, t)[2].value);
      const Real u = x[3] - s[1] * x[5], v = x[4] + s[0] * x[5];
      return (numbers_.platform_mass * (u * u + v * v) + numbers_.platform_inertia * x[5] * x[5]) /
             2;
    }
    const Limb one = limb(static_cast<std::size_t>(name.back() - '1'), t);
    const Real tension = one.stiffness * stretch(one, x);
    return name[0] == 't' ? Real(-tension * one.lever) : tension;
  }

 private:
  ManipulatorNumbers numbers_;
  Arguments trajectory_;
  PlanarWrench wrench_;
  bool rates_;
};

struct History {
  std::vector<Real> time, factor;

  /// Returns the load factor at the time t. The linear segment of the load history that contains
  /// the time `within` is extrapolated to t.
  [[nodiscard]] Real load_factor(const Real& t, const Real& within) const {
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
    platform.rate(now, dx, t, history.load_factor(t, within));
  };
  integrate(rate, x, from, to, static_cast<int>(ceil((to - from) * 4000)));
}

/// Vibration of a planar 3-RRR manipulator about its motion along a path. The links have mass and
/// very little stiffness. Each link is one cubic element of a Timoshenko beam, hinged at its elbow
/// and at the platform. In the axes of the link, which rotate with the link, the nodal
/// displacements d give the point
///
///   p(s, t) = p_nominal(s, t) + R(t) N(s) d(t).
///
/// The class Jet differentiates p twice with respect to time. The virtual work of the inertia
/// forces is
///
///   int N^T diag(rho A, rho A, rho I) (R^T p'', theta'') ds.
///
/// The damping forces are b M times the velocities of the displacements in world axes, with the
/// mass matrix M and the damping coefficient b. Fehlberg's method of order 8 integrates the
/// equations.
///
/// Coordinates: u_x, u_y, theta of P; then for each limb u_x, u_y of B and the rotations of the
/// proximal link's end, of the distal link's start and of the distal link's end.
constexpr std::size_t kCoordinates = 18, kOfPlatform = 3, kOfLimb = 5;
using Coordinates = Eigen::Matrix<Real, kCoordinates, 1>;
using SystemState = std::array<Real, 2 * kCoordinates>;
using SystemMotion = std::array<Jet<Real>, kCoordinates>;
using Six = Eigen::Matrix<Real, 6, 1>;

/// Returns the displacement u with u'' replaced by u'' + b u', which adds the damping force per
/// unit mass with the coefficient b.
Jet<Real> damped(const Jet<Real>& u, const Real& damping) {
  return {u.value, u.rate, u.acceleration + damping * u.rate};
}

/// Returns the shape functions of a Timoshenko beam element at x (0 to 1), with the rows u, v and
/// rotation and a column for each nodal displacement (Friedman and Kosmatka 1993).
/// @param phi  shear parameter 12 EI/(kappa G A L^2)
std::array<Six, 3> interpolation(const Real& x, const Real& length, const Real& phi) {
  const Real g = 1 / (1 + phi), y = 1 - x;
  const auto lift = [&](const Real& z) {  // v due to a unit v at z = 0
    return Real(g * (1 - 3 * z * z + 2 * z * z * z + phi * (1 - z)));
  };
  const auto swing = [&](const Real& z) {  // v due to a unit rotation at z = 0
    return Real(g * length * z * (1 - z) * (1 - z + phi / 2));
  };
  const auto tilt = [&](const Real& z) { return Real(g * (1 - z) * (1 - 3 * z + phi)); };
  const Real shear = 6 * g * x * y / length;
  return {{{y, 0, 0, x, 0, 0},
           {0, lift(x), swing(x), 0, lift(y), -swing(y)},
           {0, -shear, tilt(x), 0, shear, tilt(y)}}};
}

/// Nominal motion of a link: position of its first joint, and its direction.
struct LinkPose {
  LinkPose(const PointJet& start, const PointJet& end, const Real& length)
      : from(start),
        c((end[0] - start[0]) / length),
        s((end[1] - start[1]) / length),
        angle(direction_angle(start, end)) {}
  PointJet from;
  Jet<Real> c, s, angle;
};

class Link {
 public:
  explicit Link(const LinkNumbers& link) : length_(link.length), section_(link.section) {
    const Real phi = 12 * section_.EI * section_.shear_compliance / (length_ * length_);
    for (std::size_t p = 0; p < N_.size(); ++p) N_[p] = interpolation(Real(p) / 6, length_, phi);
  }

  /// Computes the inertia and damping forces of a link at its nodes, in world axes.
  /// @param u  displacements of the nodes in world axes: x, y and rotation at the start and the end
  [[nodiscard]] Six forces(const LinkPose& pose, std::array<Jet<Real>, 6> u,
                           const Real& damping) const {
    const auto& [from, c, s, angle] = pose;
    for (Jet<Real>& displacement : u) displacement = damped(displacement, damping);
    const std::array<Jet<Real>, 6> d = {c * u[0] + s * u[1], c * u[1] - s * u[0], u[2],
                                        c * u[3] + s * u[4], c * u[4] - s * u[3], u[5]};
    Six f = Six::Zero();
    constexpr std::array<int, 7> kWeights = {41, 216, 27, 272, 27, 216, 41};  // Newton-Cotes rule
    for (std::size_t p = 0; p < N_.size(); ++p) {
      const auto& N = N_[p];
      Jet<Real> along = Real(length_ * p / 6) + N[0][0] * d[0] + N[0][3] * d[3], across;
      Real rotation = angle.acceleration;
      for (const std::size_t k : {1, 2, 4, 5}) {
        across = across + N[1][k] * d[k];
        rotation += N[2][k] * d[k].acceleration;
      }
      const Real ax = (from[0] + c * along - s * across).acceleration;
      const Real ay = (from[1] + s * along + c * across).acceleration;
      const Real mass = length_ * kWeights[p] / 840 * section_.mass;
      f += mass * (c.value * ax + s.value * ay) * N[0] +
           mass * (c.value * ay - s.value * ax) * N[1] +
           length_ * kWeights[p] / 840 * section_.rotary_inertia * rotation * N[2];
    }
    return {c.value * f[0] - s.value * f[1], s.value * f[0] + c.value * f[1], f[2],
            c.value * f[3] - s.value * f[4], s.value * f[3] + c.value * f[4], f[5]};
  }

 private:
  Real length_;
  FrameSection section_;
  std::array<std::array<Six, 3>, 7> N_;
};

class Links {
 public:
  explicit Links(const Arguments& arguments)
      : numbers_(read_planar_manipulator(arguments)),
        trajectory_(trajectory_arguments(arguments)),
        wrench_(read_wrench(arguments)),
        damping_(arguments.number("mass_damping_per_s", 0)) {
    for (const LimbNumbers& limb : numbers_.limbs)
      links_.push_back({Link(limb.proximal), Link(limb.distal)});
  }

  /// Solves the equations of motion for the accelerations.
  /// @param torques  if not null, receives the torques of the base on the proximal links
  [[nodiscard]] SystemMotion solve_motion(const SystemState& x, const Real& t,
                                          std::array<Real, 3>* torques = nullptr) const {
    const Nominal now = nominal(t);
    SystemMotion motion;
    for (std::size_t j = 0; j < kCoordinates; ++j) motion[j] = {x[j], x[kCoordinates + j], 0};
    const Coordinates r = residual(now, motion);
    RealMatrix M(kCoordinates, kCoordinates);
    for (std::size_t j = 0; j < kCoordinates; ++j) {
      SystemMotion accelerated = motion;
      accelerated[j].acceleration = 1;
      M.col(j) = residual(now, accelerated) - r;
    }
    const RealVector a = solve(M, -r, "a link has no mass");
    for (std::size_t j = 0; j < kCoordinates; ++j) motion[j].acceleration = a[j];
    if (torques != nullptr) static_cast<void>(residual(now, motion, torques));
    return motion;
  }

  [[nodiscard]] Real output(const std::string& name, const SystemState& x, const Real& t) const {
    if (name == "platform_rotation_rad") return x[2];
    const auto limb = static_cast<std::size_t>(name.back() - '1');
    if (name[0] == 't') {
      std::array<Real, 3> torques;
      static_cast<void>(solve_motion(x, t, &torques));
      return torques[limb];
    }
    const std::size_t component = name.find("_y_") == std::string::npos ? 0 : 1;
    return x[(name.back() == 'P' ? 0 : kOfPlatform + kOfLimb * limb) + component];
  }

 private:
  /// Nominal motion at one time: the pose of the platform, and for each limb the vector from P to C
  /// and the poses of both links.
  struct Nominal {
    std::array<Jet<Real>, 3> pose;
    std::vector<PointJet> arms;
    std::vector<std::array<LinkPose, 2>> links;
  };

  [[nodiscard]] Nominal nominal(const Real& t) const {
    Nominal now{platform_motion(trajectory_, t), {}, {}};
    for (const LimbNumbers& limb : numbers_.limbs) {
      const auto [A, B, C] = limb_joints(limb, now.pose);
      now.arms.push_back({C[0] - now.pose[0], C[1] - now.pose[1]});
      now.links.push_back(
          {LinkPose(A, B, limb.proximal.length), LinkPose(B, C, limb.distal.length)});
    }
    return now;
  }

  /// Returns the inertia and damping forces minus the loads for each coordinate of the manipulator.
  [[nodiscard]] Coordinates residual(const Nominal& now, const SystemMotion& q,
                                     std::array<Real, 3>* torques = nullptr) const {
    Coordinates r = platform_residual(now, q);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t at = kOfPlatform + kOfLimb * i;
      const PointJet& arm = now.arms[i];
      const Six f =
          links_[i][0].forces(now.links[i][0], {0, 0, 0, q[at], q[at + 1], q[at + 2]}, damping_);
      const Six g = links_[i][1].forces(
          now.links[i][1],
          {q[at], q[at + 1], q[at + 3], q[0] - q[2] * arm[1], q[1] + q[2] * arm[0], q[at + 4]},
          damping_);
      r.segment<kOfLimb>(at) << f[3] + g[0], f[4] + g[1], f[5], g[2], g[5];
      r[0] += g[3];
      r[1] += g[4];
      r[2] += arm[0].value * g[4] - arm[1].value * g[3];
      if (torques != nullptr) (*torques)[i] = f[2];
    }
    return r;
  }

  /// Returns the residual of the platform's equations of motion, with damping. The vector s points
  /// from P to the center of mass of the platform.
  [[nodiscard]] Coordinates platform_residual(const Nominal& now, const SystemMotion& q) const {
    const PointJet s = rotated(numbers_.platform_center, now.pose[2]);
    const Jet<Real> turn = damped(q[2], damping_);
    const PointJet mass = {now.pose[0] + s[0] + damped(q[0], damping_) - turn * s[1],
                           now.pose[1] + s[1] + damped(q[1], damping_) + turn * s[0]};
    const Real fx = numbers_.platform_mass * mass[0].acceleration;
    const Real fy = numbers_.platform_mass * mass[1].acceleration;
    const Real moment = numbers_.platform_inertia * (now.pose[2] + turn).acceleration;
    Coordinates r = Coordinates::Zero();
    r[0] = fx - wrench_.x;
    r[1] = fy - wrench_.y;
    r[2] = s[0].value * fy - s[1].value * fx + moment - wrench_.moment;
    return r;
  }

  ManipulatorNumbers numbers_;
  Arguments trajectory_;
  PlanarWrench wrench_;
  Real damping_;
  std::vector<std::array<Link, 2>> links_;
};

/// Returns the states of the manipulator at given times. If the links rotate by about 1 rad in
/// twelve integration steps, Fehlberg's method of order 8 has an error of 1e-13.
std::vector<SystemState> states(const Links& links, const std::vector<Real>& times) {
  constexpr int kSteps = 4;  // steps between two successive times
  const auto rate = [&](const SystemState& x, SystemState& dx, const Real& t) {
    const SystemMotion motion = links.solve_motion(x, t);
    for (std::size_t j = 0; j < kCoordinates; ++j) {
      dx[j] = motion[j].rate;
      dx[kCoordinates + j] = motion[j].acceleration;
    }
  };
  SystemState x{};
  std::vector<SystemState> found = {x};
  for (std::size_t k = 1; k < times.size(); ++k) {
    integrate(rate, x, times[k - 1], times[k], kSteps);
    found.push_back(x);
  }
  return found;
}

}  // namespace

std::vector<Real> platform_vibration_program(const Arguments& arguments) {
  const Platform platform(arguments);
  History history{{Real(0)}, {Real(1)}};
  if (arguments.has("load_history")) {
    const Arguments given(arguments["load_history"], "/load_history", {"time_s", "factor"});
    history.time = given.numbers("time_s");
    history.factor = given.numbers("factor", history.time.size());
  }
  const std::vector<Real> times = arguments.numbers("times_s");
  if (!std::ranges::is_sorted(times)) arguments.fail("times_s", "expected ascending times");
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

std::vector<Real> link_vibration_program(const Arguments& arguments) {
  const Links links(arguments);
  const std::vector<Real> times = arguments.numbers("times_s");
  if (!std::ranges::is_sorted(times)) arguments.fail("times_s", "expected ascending times");
  const std::vector<SystemState> state = states(links, times);
  std::vector<Real> values;
  for (const std::string& name : arguments.texts("outputs")) {
    for (std::size_t k = 0; k < times.size(); ++k)
      values.push_back(links.output(name, state[k], times[k]));
  }
  return values;
}

}  // namespace trammel::references
