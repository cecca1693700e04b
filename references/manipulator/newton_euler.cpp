#include "references/manipulator/newton_euler.h"

#include "references/manipulator/programs.h"
#include "references/numerics/dense.h"

namespace trammel::references {

namespace {

/// Columns of the unknowns of a limb in the equations of motion: the forces of the base on the
/// proximal link (at A), of the proximal link on the distal link (at B), of the distal link on the
/// platform (at C); the torque.
enum Unknown : int { at_A = 0, at_B = 2, at_C = 4, torque = 6, per_limb = 7 };

/// Equations of motion of one body: force balance, and moment balance about its center of mass.
class Body {
 public:
  Body(RealMatrix& A, RealVector& b, std::size_t row, const PointJet& center)
      : A_(A), b_(b), row_(row), center_(center) {}

  /// Adds `sign` times a joint force with unknown components, which acts on this body at `point`.
  void add_joint_force(std::size_t unknown, const PointJet& point, int sign) {
    A_(row_, unknown) += sign;
    A_(row_ + 1, unknown + 1) += sign;
    A_(row_ + 2, unknown) -= sign * (point[1].value - center_[1].value);
    A_(row_ + 2, unknown + 1) += sign * (point[0].value - center_[0].value);
  }
  void add_torque(std::size_t unknown) { A_(row_ + 2, unknown) += 1; }
  void add_load(const PlanarWrench& w, const PointJet& point) {
    b_[row_] -= w.x;
    b_[row_ + 1] -= w.y;
    b_[row_ + 2] -= w.moment + (point[0].value - center_[0].value) * w.y -
                    (point[1].value - center_[1].value) * w.x;
  }
  void add_inertia(const Real& mass, const Real& J, const Real& angular_acceleration,
                   const Point2<Real>& gravity) {
    b_[row_] += mass * (center_[0].acceleration - gravity[0]);
    b_[row_ + 1] += mass * (center_[1].acceleration - gravity[1]);
    b_[row_ + 2] += J * angular_acceleration;
  }

 private:
  RealMatrix& A_;
  RealVector& b_;
  std::size_t row_;
  const PointJet center_;
};

}  // namespace

PointJet mass_center(const LinkNumbers& link, const PointJet& from, const PointJet& to) {
  const Real share = link.center / link.length;
  return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

PointJet platform_mass_center(const ManipulatorNumbers& manipulator,
                              const std::array<Jet<Real>, 3>& motion) {
  const PointJet offset = rotated(manipulator.platform_center, motion[2]);
  return {motion[0] + offset[0], motion[1] + offset[1]};
}

Jet<Real> direction_angle(const PointJet& from, const PointJet& to) {
  const Jet<Real> x = to[0] - from[0], y = to[1] - from[1];
  const Real r2 = x.value * x.value + y.value * y.value;
  const Real rate = (x.value * y.rate - y.value * x.rate) / r2;
  const Real stretch = (x.value * x.rate + y.value * y.rate) / r2;
  return {atan2(y.value, x.value), rate,
          (x.value * y.acceleration - y.value * x.acceleration) / r2 - 2 * rate * stretch};
}

std::array<PointJet, 3> limb_joints(const LimbNumbers& limb,
                                    const std::array<Jet<Real>, 3>& motion) {
  const PointJet base_joint = {limb.base[0], limb.base[1]};
  const PointJet corner = rotated(limb.corner, motion[2]);
  const PointJet C = {motion[0] + corner[0], motion[1] + corner[1]};
  return {base_joint,
          elbow<Jet<Real>>(base_joint, C, limb.proximal.length, limb.distal.length, limb.mode), C};
}

ManipulatorForces newton_euler_forces(const ManipulatorNumbers& m,
                                      const std::array<Jet<Real>, 3>& motion,
                                      const PlanarWrench& wrench) {
  RealMatrix A = RealMatrix::Zero(21, 21);
  RealVector b = RealVector::Zero(21);
  Body platform(A, b, 18, platform_mass_center(m, motion));
  platform.add_inertia(m.platform_mass, m.platform_inertia, motion[2].acceleration, m.gravity);
  platform.add_load(wrench, {motion[0], motion[1]});
  for (std::size_t i = 0; i < 3; ++i) {
    const LimbNumbers& limb = m.limbs[i];
    const auto [base_joint, B, C] = limb_joints(limb, motion);
    const std::size_t first = per_limb * i;
    Body proximal(A, b, 6 * i, mass_center(limb.proximal, base_joint, B));
    proximal.add_joint_force(first + at_A, base_joint, 1);
    proximal.add_joint_force(first + at_B, B, -1);
    proximal.add_torque(first + torque);
    proximal.add_inertia(limb.proximal.mass, limb.proximal.inertia,
                         direction_angle(base_joint, B).acceleration, m.gravity);
    Body distal(A, b, 6 * i + 3, mass_center(limb.distal, B, C));
    distal.add_joint_force(first + at_B, B, 1);
    distal.add_joint_force(first + at_C, C, -1);
    distal.add_inertia(limb.distal.mass, limb.distal.inertia, direction_angle(B, C).acceleration,
                       m.gravity);
    platform.add_joint_force(first + at_C, C, 1);
  }
  const RealVector x = solve(A, b, "the pose is singular: no torques balance the loads");
  ManipulatorForces forces;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t first = per_limb * i;
    forces.torque[i] = x[first + torque];
    forces.on_platform[i] = {x[first + at_C], x[first + at_C + 1]};
  }
  return forces;
}

ManipulatorNumbers read_planar_manipulator(const Arguments& arguments) {
  ManipulatorNumbers numbers = read_manipulator_numbers(manipulator_arguments(arguments));
  numbers.gravity = arguments.point_or_origin("gravity_m_s2");
  return numbers;
}

PlanarWrench read_wrench(const Arguments& arguments) {
  const auto force = arguments.point_or_origin("force_N");
  return {force[0], force[1], arguments.number("moment_N_m", 0)};
}

Arguments trajectory_arguments(const Arguments& arguments) {
  return arguments.object("trajectory", {"circle", "line", "rest_to_rest", "spline"});
}

std::vector<Real> manipulator_torques_program(const Arguments& arguments) {
  const ManipulatorNumbers manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory = trajectory_arguments(arguments);
  const std::vector<Real> times = arguments.numbers("times_s");
  std::vector<Real> values(3 * times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto torques =
        newton_euler_forces(manipulator, platform_motion(trajectory, times[k]), wrench).torque;
    for (std::size_t i = 0; i < 3; ++i) values[i * times.size() + k] = torques[i];
  }
  return values;
}

}  // namespace trammel::references
