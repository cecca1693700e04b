#include "harness/motion/analyse_inverse_dynamics.h"

#include <cmath>
#include <numbers>

#include "harness/scene/rigid_case_model.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using JointNames = std::array<std::string, 3>;
const JointNames& active_names() {
  static const JointNames names = {"A1", "A2", "A3"};
  return names;
}
const JointNames& elbow_names() {
  static const JointNames names = {"B1", "B2", "B3"};
  return names;
}
const std::array<std::string, 7>& body_names() {
  static const std::array<std::string, 7> names = {"A1-B1", "A2-B2", "A3-B3",   "B1-C1",
                                                   "B2-C2", "B3-C3", "platform"};
  return names;
}

void record_joints(const solver::InverseDynamics& found, Recorder& record) {
  for (solver::Index i = 0; i < 3; ++i) {
    const std::string& active = active_names()[solver::to_size(i)];
    const std::string& elbow = elbow_names()[solver::to_size(i)];
    record.add("torque_N_m", active, found.torque(i));
    record.add("active_angle_rad", active, found.q(i));
    record.add("active_velocity_rad_per_s", active, found.q_dot(i));
    record.add("active_acceleration_rad_per_s2", active, found.q_ddot(i));
    record.add("passive_angle_rad", elbow, found.q(3 + i));
    record.add("passive_velocity_rad_per_s", elbow, found.q_dot(3 + i));
    record.add("passive_acceleration_rad_per_s2", elbow, found.q_ddot(3 + i));
  }
}

void record_bodies(const solver::InverseDynamics& found, Recorder& record) {
  for (std::size_t b = 0; b < found.bodies.size(); ++b) {
    const solver::BodyMotion& body = found.bodies[b];
    const std::string& name = body_names()[b];
    record.add("center_x_m", name, body.position.x());
    record.add("center_y_m", name, body.position.y());
    record.add("center_velocity_x_m_per_s", name, body.velocity.x());
    record.add("center_velocity_y_m_per_s", name, body.velocity.y());
    record.add("center_acceleration_x_m_per_s2", name, body.acceleration.x());
    record.add("center_acceleration_y_m_per_s2", name, body.acceleration.y());
  }
}

double power_scale(const solver::InverseDynamics& found) {
  return found.torque.norm() * found.q_dot.head<3>().norm() + std::abs(found.load_power) +
         std::abs(found.gravity_power) + std::abs(found.kinetic_power);
}

/// @returns the residual of the power balance, relative to all powers
double record_energy(const solver::InverseDynamics& found, Recorder& record) {
  record.add("kinetic_energy_J", "", found.kinetic_energy);
  record.add("kinetic_power_W", "", found.kinetic_power);
  record.add("actuator_power_W", "", found.actuator_power);
  record.add("load_power_W", "", found.load_power);
  record.add("gravity_power_W", "", found.gravity_power);
  const double fed = found.actuator_power + found.load_power + found.gravity_power;
  const double scale = power_scale(found);
  const double residual = scale > 0 ? (found.kinetic_power - fed) / scale : 0;
  record.add("power_residual", "", residual);
  return residual;
}

void record_properties(const solver::RigidManipulator& manipulator,
                       const solver::TrajectoryPoint& point, Recorder& record) {
  const solver::PropertyResiduals residuals = solver::property_residuals(
      manipulator, solver::rigid_terms(manipulator, point.pose, point.velocity));
  record.add("symmetry_residual", "", residuals.symmetry);
  record.add("skewness_residual", "", residuals.skewness);
  record.add("min_inertia_eigenvalue_kg_m2", "", residuals.min_eigenvalue);
}

/// Work of the actuators over exactly one turn, by the trapezoid rule, which for a periodic
/// integrand converges faster than any power of the step: inertia, gravity and a constant load
/// leave none. Beside it what goes to and fro, the integral of |power|.
void record_turn(const solver::RigidManipulator& manipulator, const CaseModel& case_model,
                 const solver::Circle& circle, int points, Recorder& record) {
  const double period = 2 * std::numbers::pi / std::abs(circle.angular_speed);
  double work = 0, turnover = 0;
  for (int k = 0; k < points; ++k) {
    const solver::TrajectoryPoint point = solver::at(circle, period * k / points);
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) return;  // the path's own points tell why
    work += found.actuator_power * period / points;
    turnover += std::abs(found.actuator_power) * period / points;
  }
  record.add("cycle_work_J", "", work);
  record.add("cycle_absolute_work_J", "", turnover);
  record.add("cycle_work_residual", "", work / turnover);
}

}  // namespace

StepResult analyse_inverse_dynamics(const JsonView& analysis, const CaseModel& case_model,
                                    bool draw, Recorder& record) {
  const solver::RigidManipulator manipulator = read_rigid_manipulator(analysis, case_model);
  const bool bodies = analysis.get("bodies", false);
  StepResult result;
  if (draw) result.drawing = draw_manipulator(manipulator.geometry, case_model.motion);
  for (std::size_t step = 0; step < case_model.motion.size(); ++step) {
    const solver::TrajectoryPoint& point = case_model.motion[step];
    record_path(case_model, step, record);
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) {
      result.outcome = outcome_at_path_point(case_model, step, found.outcome);
      return result;
    }
    record_joints(found, record);
    result.evidence.add(solver::Residual::energy, std::abs(record_energy(found, record)));
    record_properties(manipulator, point, record);
    if (bodies) record_bodies(found, record);
  }
  const auto* circle = case_model.path ? std::get_if<solver::Circle>(&*case_model.path) : nullptr;
  if (circle && circle->angular_speed != 0) {
    record_turn(manipulator, case_model, *circle, analysis.get("points_per_revolution", 64),
                record);
  }
  return result;
}

}  // namespace trammel::harness
