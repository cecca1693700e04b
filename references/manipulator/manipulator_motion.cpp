#include <boost/math/quadrature/gauss.hpp>
#include <map>

#include "references/manipulator/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/integration.h"
#include "references/numerics/real.h"

/// Quantities of the motion of a rigid planar 3-RRR manipulator along a path or under constant
/// torques.
namespace trammel::references {

namespace {

using Motion = std::array<Jet<Real>, 3>;

/// Quantities of the motion of the manipulator at one time, by name.
class Instant {
 public:
  Instant(const ManipulatorNumbers& manipulator, const Motion& motion, const PlanarWrench& wrench)
      : m_(manipulator), motion_(motion), forces_(newton_euler_forces(m_, motion, wrench)) {
    const char* axes[] = {"x", "y", "phi"};
    const char* units[] = {"m", "m", "rad"};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string axis = axes[c], unit = units[c];
      values_["motion_" + axis + "_" + unit] = motion[c].value;
      values_["motion_velocity_" + axis + "_" + unit + "_per_s"] = motion[c].rate;
    }
    for (const char* power : {"kinetic_energy_J", "kinetic_power_W", "actuator_power_W"})
      values_[power] = 0;
    values_["load_power_W"] =
        wrench.x * motion[0].rate + wrench.y * motion[1].rate + wrench.moment * motion[2].rate;
    values_["gravity_power_W"] = 0;
    for (std::size_t i = 0; i < 3; ++i) add_limb(i);
    add_body("platform", platform_mass_center(m_, motion), motion[2], m_.platform_mass,
             m_.platform_inertia);
    add_singularities();
  }

  [[nodiscard]] Real value(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw DerivationError("/outputs: '" + name + "': no such quantity");
    return abs(found->second) < Real("1e-40") ? Real(0) : found->second;  // else round-off
  }

 private:
  void add_limb(std::size_t i) {
    const LimbNumbers& limb = m_.limbs[i];
    const auto [A, B, C] = limb_joints(limb, motion_);
    const std::string n = std::to_string(i + 1);
    const Jet<Real> active = direction_angle(A, B), passive = direction_angle(B, C);
    add_angle("active_", ":A" + n, active);
    add_angle("passive_", ":B" + n, passive);
    const auto cross = [](const PointJet& o, const PointJet& p, const PointJet& q) {
      return Real((p[0].value - o[0].value) * (q[1].value - p[1].value) -
                  (p[1].value - o[1].value) * (q[0].value - p[0].value));
    };
    values_["elbow_sine:B" + n] = cross(A, B, C) / (limb.proximal.length * limb.distal.length);
    const Point2<Real> along = {(B[0].value - C[0].value) / limb.distal.length,
                                (B[1].value - C[1].value) / limb.distal.length};
    const Point2<Real>& force = forces_.on_platform[i];
    values_["distal_tension_N:B" + n + "-C" + n] = along[0] * force[0] + along[1] * force[1];
    directions_[i] = {-along[0], -along[1]};
    values_["torque_N_m:A" + n] = values_["holding_torque_N_m:A" + n] = forces_.torque[i];
    values_["actuator_power_W"] += forces_.torque[i] * active.rate;
    add_body("A" + n + "-B" + n, mass_center(limb.proximal, A, B), active, limb.proximal.mass,
             limb.proximal.inertia);
    add_body("B" + n + "-C" + n, mass_center(limb.distal, B, C), passive, limb.distal.mass,
             limb.distal.inertia);
  }

  void add_angle(const std::string& kind, const std::string& joint, const Jet<Real>& angle) {
    values_[kind + "angle_rad" + joint] = angle.value;
    values_[kind + "velocity_rad_per_s" + joint] = angle.rate;
    values_[kind + "acceleration_rad_per_s2" + joint] = angle.acceleration;
  }

  void add_body(const std::string& name, const PointJet& center, const Jet<Real>& angle,
                const Real& mass, const Real& inertia) {
    values_["kinetic_energy_J"] += inertia * angle.rate * angle.rate / 2;
    values_["kinetic_power_W"] += inertia * angle.rate * angle.acceleration;
    for (std::size_t c = 0; c < 2; ++c) {
      const std::string axis = c == 0 ? "x" : "y";
      values_["center_" + axis + "_m:" + name] = center[c].value;
      values_["center_velocity_" + axis + "_m_per_s:" + name] = center[c].rate;
      values_["center_acceleration_" + axis + "_m_per_s2:" + name] = center[c].acceleration;
      values_["kinetic_energy_J"] += mass * center[c].rate * center[c].rate / 2;
      values_["kinetic_power_W"] += mass * center[c].rate * center[c].acceleration;
      values_["gravity_power_W"] += mass * m_.gravity[c] * center[c].rate;
    }
  }

  /// Adds the distances from parallel and serial singularities. The parallel distance is the ratio
  /// of the smallest to the largest singular value of a matrix. Its rows are the Pluecker
  /// coordinates of the distal links, with moments about P divided by the platform radius. The
  /// serial distance is the smallest |sine| of an elbow angle.
  void add_singularities() {
    Real squares = 0;
    for (const LimbNumbers& limb : m_.limbs)
      squares += limb.corner[0] * limb.corner[0] + limb.corner[1] * limb.corner[1];
    const Real radius = sqrt(squares / 3);
    RealMatrix lines(3, 3);
    Real serial = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2<Real>& d = directions_[i];
      const auto C = limb_joints(m_.limbs[i], motion_)[2];
      lines(i, 0) = d[0];
      lines(i, 1) = d[1];
      lines(i, 2) =
          ((C[0].value - motion_[0].value) * d[1] - (C[1].value - motion_[1].value) * d[0]) /
          radius;
      const Real sine = abs(values_["elbow_sine:B" + std::to_string(i + 1)]);
      if (sine < serial) serial = sine;
    }
    const RealVector singular = Eigen::JacobiSVD<RealMatrix>(lines).singularValues();
    values_["parallel_singularity_distance"] = singular[2] / singular[0];
    values_["serial_singularity_distance"] = serial;
  }

  const ManipulatorNumbers& m_;
  const Motion motion_;
  const ManipulatorForces forces_;
  std::array<Point2<Real>, 3> directions_;
  std::map<std::string, Real> values_;
};

/// Returns the accelerations of the platform under given torques. The torques depend linearly on
/// the three accelerations, so that four solutions of the inverse dynamics suffice.
RealVector accelerations(const ManipulatorNumbers& m, const PlanarWrench& wrench,
                         const std::vector<Real>& torque, const std::array<Real, 6>& state) {
  const auto torques_at = [&](int moving) {
    Motion motion;
    for (int c = 0; c < 3; ++c)
      motion[c] = {state[c], state[3 + c], moving == c ? Real(1) : Real(0)};
    return newton_euler_forces(m, motion, wrench).torque;
  };
  const auto at_rest = torques_at(-1);
  RealMatrix A(3, 3);
  RealVector b(3);
  for (int c = 0; c < 3; ++c) {
    const auto moved = torques_at(c);
    for (int i = 0; i < 3; ++i) A(i, c) = moved[i] - at_rest[i];
    b[c] = torque[c] - at_rest[c];
  }
  return solve(A, b, "the pose is singular");
}

/// Computes the motion under constant torques at given times, with 16 integration steps between
/// successive times.
std::vector<Motion> motions_under_torques(const ManipulatorNumbers& m, const PlanarWrench& wrench,
                                          const std::vector<Real>& torque, const Motion& start,
                                          const std::vector<Real>& times) {
  using State = std::array<Real, 6>;  // x, y, phi of the platform and their rates
  State state;
  for (int c = 0; c < 3; ++c) {
    state[c] = start[c].value;
    state[3 + c] = start[c].rate;
  }
  const auto rate = [&](const State& y, State& dy, const Real&) {
    const RealVector a = accelerations(m, wrench, torque, y);
    dy = {y[3], y[4], y[5], a[0], a[1], a[2]};
  };
  std::vector<Motion> motions;
  Real time = 0;
  for (const Real& next : times) {
    if (next > time) integrate(rate, state, time, next, 8);
    time = next;
    const RealVector a = accelerations(m, wrench, torque, state);
    Motion motion;
    for (int c = 0; c < 3; ++c) motion[c] = {state[c], state[3 + c], a[c]};
    motions.push_back(motion);
  }
  return motions;
}

/// Integrates |power| of the actuators over one turn of the circular path, between zeros of the
/// power.
Real absolute_work_of_one_turn(const ManipulatorNumbers& m, const Arguments& trajectory,
                               const PlanarWrench& wrench) {
  const Arguments circle(trajectory["circle"], "/trajectory/circle");
  const Real period = 2 * pi<Real>() / abs(circle.number("angular_speed_rad_s", 1));
  const auto power = [&](const Real& t) {
    return Instant(m, platform_motion(trajectory, t), wrench).value("actuator_power_W");
  };
  constexpr int kIntervals = 64;
  Real work = 0, from = 0, before = power(from);
  for (int k = 1; k <= kIntervals; ++k) {
    const Real to = period * k / kIntervals, now = power(to);
    const Real zero = (before < 0) != (now < 0) ? refined_root(power, from, to) : to;
    // Ten Gauss points per 64th of a turn integrate the smooth power to about 30 digits.
    using Gauss = boost::math::quadrature::gauss<Real, 10>;
    work += abs(Gauss::integrate(power, from, zero));
    if (zero < to) work += abs(Gauss::integrate(power, zero, to));
    from = to;
    before = now;
  }
  return work;
}

}  // namespace

std::vector<Real> manipulator_motion_program(const Arguments& arguments) {
  const ManipulatorNumbers manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory = trajectory_arguments(arguments);
  const std::vector<std::string> outputs = arguments.texts("outputs");
  if (outputs.front() == "cycle_absolute_work_J")
    return {absolute_work_of_one_turn(manipulator, trajectory, wrench)};
  const std::vector<Real> times = arguments.numbers("times_s");
  std::vector<Motion> motions;
  if (arguments.has("torque_N_m")) {
    motions = motions_under_torques(manipulator, wrench, arguments.numbers("torque_N_m", 3),
                                    platform_motion(trajectory, 0), times);
  } else {
    for (const Real& time : times) motions.push_back(platform_motion(trajectory, time));
  }
  std::vector<std::vector<Real>> table(outputs.size());
  for (Motion& motion : motions) {
    if (arguments.flag("at_rest", false))
      for (Jet<Real>& coordinate : motion) coordinate = coordinate.value;
    const Instant now(manipulator, motion, wrench);
    for (std::size_t i = 0; i < outputs.size(); ++i) table[i].push_back(now.value(outputs[i]));
  }
  std::vector<Real> values;
  for (const auto& row : table) values.insert(values.end(), row.begin(), row.end());
  return values;
}

}  // namespace trammel::references
