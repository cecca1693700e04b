#include <cmath>
#include <numbers>

#include "harness/motion/analyses.h"
#include "harness/scene/case_model.h"
#include "solver/manipulator/forward_dynamics.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::harness {
namespace {

double turned(double from, double to) {
  return std::remainder(to - from, 2 * std::numbers::pi);
}

/// Records the drift of the energy, relative to the largest kinetic energy. The energy is the
/// kinetic plus potential energy, minus the work of torques and load since the start. This sum is
/// conserved, because constant torques and a constant load do work that depends only on the pose.
void record_energy(const solver::RigidManipulator& m, const solver::ForwardDynamics& found,
                   const Eigen::Vector3d& torque, const Eigen::Vector3d& wrench, Recorder& record) {
  std::vector<double> energies;
  double work = 0, max_kinetic = 0;
  solver::InverseDynamics before;
  for (const solver::TrajectoryPoint& point : found.motion) {
    const solver::InverseDynamics now = solver::inverse_dynamics(m, point);
    if (!energies.empty()) {
      for (solver::Index i = 0; i < 3; ++i) work += torque(i) * turned(before.q(i), now.q(i));
      work += wrench.head<2>().dot(now.q.segment<2>(6) - before.q.segment<2>(6)) +
              wrench(2) * (now.q(8) - before.q(8));
    }
    record.add("kinetic_energy_J", now.kinetic_energy);
    energies.push_back(now.kinetic_energy + now.potential_energy - work);
    max_kinetic = std::max(max_kinetic, now.kinetic_energy);
    before = now;
  }
  for (const double energy : energies)
    record.add("energy_residual",
               (energy - energies.front()) / (max_kinetic > 0 ? max_kinetic : 1));
}

}  // namespace

StepResult analyze_forward_dynamics(const JsonView& analysis, const CaseModel& case_model,
                                    bool draw, Recorder& record) {
  const solver::RigidManipulator manipulator = read_rigid_manipulator(analysis, case_model);
  if (!case_model.path)
    throw analysis.error("forward dynamics requires a model with 'trajectory' (got 'pose')");
  if (!loads_at_P_only(case_model))
    throw analysis.error("forward dynamics supports only loads at node P (got C1, C2 or C3)");
  const Eigen::Vector3d wrench = wrench_on_platform(case_model, case_model.motion.front().pose);
  const bool given = analysis.has("torque_N_m");
  Eigen::Vector3d constant = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; given && i < 3; ++i)
    constant(static_cast<solver::Index>(i)) = analysis["torque_N_m"][i].get<double>();
  // The integrator may evaluate times slightly past the end of the path, where a spline is
  // undefined.
  const double last = case_model.motion.back().time;
  const auto torque = [&](double time) -> Eigen::Vector3d {
    if (given) return constant;
    return solver::inverse_dynamics(manipulator, solver::at(*case_model.path, std::min(time, last)),
                                    wrench)
        .torque;
  };
  std::vector<double> times;
  for (const solver::TrajectoryPoint& point : case_model.motion) times.push_back(point.time);
  solver::ForwardOptions options;
  options.tolerance = analysis.get("tolerance", options.tolerance);
  const solver::ForwardDynamics found = solver::forward_dynamics(
      manipulator, case_model.motion.front(), torque, times, wrench, options);
  StepResult result;
  result.outcome = found.outcome;
  result.evidence = found.evidence;
  if (draw) result.drawing = draw_manipulator(manipulator.geometry, case_model.motion);
  for (std::size_t step = 0; step < found.motion.size(); ++step) {
    const solver::TrajectoryPoint& moved = found.motion[step];
    record.add("motion_x_m", moved.pose.x);
    record.add("motion_y_m", moved.pose.y);
    record.add("motion_phi_rad", moved.pose.phi);
    record.add("motion_velocity_x_m_per_s", moved.velocity.x());
    record.add("motion_velocity_y_m_per_s", moved.velocity.y());
    record.add("motion_velocity_phi_rad_per_s", moved.velocity.z());
    if (given) continue;  // the path is not followed under torques stated in the case
    const solver::TrajectoryPoint& nominal = case_model.motion[step];
    record.add("position_error_m",
               std::hypot(moved.pose.x - nominal.pose.x, moved.pose.y - nominal.pose.y));
    record.add("orientation_error_rad", std::abs(turned(nominal.pose.phi, moved.pose.phi)));
    record.add("velocity_error_m_per_s", (moved.velocity - nominal.velocity).head<2>().norm());
  }
  if (given) record_energy(manipulator, found, constant, wrench, record);
  record.add("steps", found.steps);
  record.add("rejected_steps", found.rejected);
  record.add("evaluations", found.evaluations);
  return result;
}

}  // namespace trammel::harness
