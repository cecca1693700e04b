#include <cmath>
#include <numbers>

#include "harness/motion/analyses.h"
#include "harness/scene/case_model.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::harness {
namespace {

void record_joints(const solver::InverseDynamics& found, Recorder& record) {
  record.add_each("torque_N_m", kActiveJoints, found.torque);
  const auto active = Eigen::seqN(0, 3), passive = Eigen::seqN(3, 3);
  record.add_each("active_angle_rad", kActiveJoints, found.q(active));
  record.add_each("active_velocity_rad_per_s", kActiveJoints, found.q_dot(active));
  record.add_each("active_acceleration_rad_per_s2", kActiveJoints, found.q_ddot(active));
  record.add_each("passive_angle_rad", kElbows, found.q(passive));
  record.add_each("passive_velocity_rad_per_s", kElbows, found.q_dot(passive));
  record.add_each("passive_acceleration_rad_per_s2", kElbows, found.q_ddot(passive));
}

void record_bodies(const solver::InverseDynamics& found, Recorder& record) {
  for (std::size_t b = 0; b < found.bodies.size(); ++b) {
    const solver::BodyMotion& body = found.bodies[b];
    record.add("center_x_m", kBodies[b], body.position.x());
    record.add("center_y_m", kBodies[b], body.position.y());
    record.add("center_velocity_x_m_per_s", kBodies[b], body.velocity.x());
    record.add("center_velocity_y_m_per_s", kBodies[b], body.velocity.y());
    record.add("center_acceleration_x_m_per_s2", kBodies[b], body.acceleration.x());
    record.add("center_acceleration_y_m_per_s2", kBodies[b], body.acceleration.y());
  }
}

/// Records the kinetic energy and the powers of the rigid manipulator at one point of the path.
/// @returns the residual of the power balance, relative to the sum of all powers
double record_energy(const solver::InverseDynamics& found, Recorder& record) {
  record.add("kinetic_energy_J", found.kinetic_energy);
  record.add("kinetic_power_W", found.kinetic_power);
  record.add("actuator_power_W", found.actuator_power);
  record.add("load_power_W", found.load_power);
  record.add("gravity_power_W", found.gravity_power);
  const double scale = found.torque.norm() * found.q_dot.head<3>().norm() +
                       std::abs(found.load_power) + std::abs(found.gravity_power) +
                       std::abs(found.kinetic_power);
  const double fed = found.actuator_power + found.load_power + found.gravity_power;
  const double residual = scale > 0 ? (found.kinetic_power - fed) / scale : 0;
  record.add("power_residual", residual);
  return residual;
}

/// Records the work of the actuators during exactly one revolution of the platform point P on its
/// circular path, and the integral of the magnitude of their power. Inertia, gravity and a constant
/// load contribute no net work. For a periodic integrand, the trapezoidal rule converges faster
/// than any power of the step.
void record_work_of_turn(const solver::RigidManipulator& manipulator, const CaseModel& case_model,
                         const solver::Circle& circle, int points, Recorder& record) {
  const double period = 2 * std::numbers::pi / std::abs(circle.angular_speed);
  double work = 0, turnover = 0;
  for (int k = 0; k < points; ++k) {
    const solver::TrajectoryPoint point = solver::at(circle, period * k / points);
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) return;  // the analysis reports failures at path points
    work += found.actuator_power * period / points;
    turnover += std::abs(found.actuator_power) * period / points;
  }
  record.add("cycle_work_J", work);
  record.add("cycle_absolute_work_J", turnover);
  record.add("cycle_work_residual", work / turnover);
}

}  // namespace

StepResult analyze_inverse_dynamics(const JsonView& analysis, const CaseModel& case_model,
                                    bool draw, Recorder& record) {
  const solver::RigidManipulator manipulator = read_rigid_manipulator(analysis, case_model);
  const bool bodies = analysis.get("bodies", false);
  StepResult result;
  if (draw) result.drawing = draw_manipulator(manipulator.geometry, case_model.motion);
  for (std::size_t step = 0; step < case_model.motion.size(); ++step) {
    const solver::TrajectoryPoint& point = case_model.motion[step];
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) {
      result.outcome = outcome_at_path_point(case_model, step, found.outcome);
      return result;
    }
    record_joints(found, record);
    result.evidence.add(solver::Residual::energy, std::abs(record_energy(found, record)));
    const solver::PropertyResiduals residuals = solver::property_residuals(
        manipulator, solver::rigid_terms(manipulator, point.pose, point.velocity));
    record.add("symmetry_residual", residuals.symmetry);
    record.add("skewness_residual", residuals.skewness);
    record.add("min_inertia_eigenvalue_kg_m2", residuals.min_eigenvalue);
    if (bodies) record_bodies(found, record);
  }
  const auto* circle = case_model.path ? std::get_if<solver::Circle>(&*case_model.path) : nullptr;
  if (circle && circle->angular_speed != 0)
    record_work_of_turn(manipulator, case_model, *circle, analysis.get("points_per_revolution", 64),
                        record);
  return result;
}

}  // namespace trammel::harness
