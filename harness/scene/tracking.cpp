#include "harness/scene/tracking.h"

#include <algorithm>

#include "harness/scene/case_model.h"
#include "solver/large/consistent_initialization.h"
#include "solver/large/large_elastodynamics.h"
#include "solver/large/state_results.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

void require_joints(const JsonView& place, const solver::ManipulatorDesign& design) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (design.active[i].kind != solver::ActiveKind::locked)
      throw place.error("'tracking' of a path requires 'locked' active joints (got another type)");
    if (design.elbow[i].kind != solver::ElbowKind::hinged ||
        design.platform_joint[i].kind != solver::PlatformJointKind::hinged) {
      throw place.error(
          "'tracking' of a path requires hinged elbow and platform joints (got another type)");
    }
  }
}

/// Returns the motion of the manipulator with rigid links, and the actuator torques that balance
/// inertia and loads. Before and after the path, it returns the state at the nearest end.
solver::large_motion::RigidMotion rigid_motion_with_torques(
    const solver::RigidManipulator& rigid, const CaseModel& case_model,
    const std::function<double(double)>& load_history) {
  return solver::large_motion::cached_motion([rigid, case_model, load_history](double t) {
    const auto [first, last] = solver::time_span(*case_model.path);
    const solver::TrajectoryPoint point = solver::at(*case_model.path, std::clamp(t, first, last));
    const Eigen::Vector3d wrench =
        (load_history ? load_history(t) : 1.0) * wrench_on_platform(case_model, point.pose);
    return solver::inverse_dynamics(rigid, point, wrench);
  });
}

/// Returns the initial velocities of the same manipulator with rigid links (its rigid twin).
solver::large_motion::PrescribedVelocities initial_tracking_velocities(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system) {
  const solver::TrajectoryPoint start = solver::at(*case_model.path, 0);
  const solver::InverseDynamics twin =
      solver::inverse_dynamics(solver::rigid_manipulator(*case_model.manipulator), start);
  const Eigen::VectorXd rates = nominal_motion_derivative(
      system, solver::nominal_motion(system.model(), twin, twin.q, start, {0, 0}), 1);
  solver::large_motion::PrescribedVelocities velocities;
  for (solver::Index k = 0; k < rates.size(); ++k) velocities.emplace_back(k, rates[k]);
  return velocities;
}

}  // namespace

void add_tracking(const JsonView& place, Tracking tracking, const CaseModel& case_model,
                  const solver::Model& model,
                  solver::large_motion::LargeMotionModel& large_motion) {
  if (!case_model.manipulator || !case_model.path)
    throw place.error("'tracking' of a path requires a manipulator with 'trajectory'");
  require_joints(place, *case_model.manipulator);
  const bool torques = tracking == Tracking::torques;
  const solver::RigidManipulator rigid = torques
                                             ? read_rigid_manipulator(place, case_model)
                                             : solver::rigid_manipulator(*case_model.manipulator);
  const solver::large_motion::RigidMotion motion =
      torques ? rigid_motion_with_torques(rigid, case_model, large_motion.load_history)
              : solver::large_motion::cached_motion([rigid, path = *case_model.path](double t) {
                  return solver::inverse_dynamics(rigid, solver::at(path, t));
                });
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "A" + std::to_string(i + 1);
    const solver::Index node = model.find_node(name);
    if (torques) {
      const auto torque = [motion, k = static_cast<solver::Index>(i)](double t) {
        return motion(t).torque[k];
      };
      large_motion.torques.push_back({name, node, torque});
    } else {
      large_motion.drives.push_back(
          {name, node, 2,
           solver::large_motion::joint_rotation_law(motion, *case_model.path, 0,
                                                    static_cast<solver::Index>(i))});
    }
  }
}

void record_actuator_drives(const solver::large_motion::GeometricallyExactSystem& system,
                            const solver::large_motion::State& state, Recorder& record) {
  const std::vector<solver::large_motion::Drive>& drives = system.large_motion().drives;
  for (std::size_t i = 0; i < drives.size(); ++i)
    record.add(drives[i].direction == 2 ? "drive_torque_N_m" : "drive_force_N", drives[i].name,
               drive_force(system, state, static_cast<solver::Index>(i)));
}

void release_driven_actuators(const JsonView& analysis, const CaseModel& case_model,
                              const solver::large_motion::LargeMotionModel& large_motion,
                              solver::Model& model) {
  for (const solver::large_motion::Drive& drive : large_motion.drives) {
    // The first three supports and the first three nodes of a built manipulator belong to its
    // actuators, in the same order.
    if (!case_model.manipulator || drive.direction != 2 || drive.node > 2) continue;
    const auto limb = solver::to_size(drive.node);
    if (case_model.manipulator->active[limb].kind == solver::ActiveKind::free)
      throw analysis["drives"][drive.name].error(
          "a free active joint cannot be driven; expected a locked joint or a spring");
    model.supports[limb].fixed[2] = false;
  }
  for (const solver::large_motion::Torque& torque : large_motion.torques)
    model.supports[solver::to_size(torque.node)].fixed[2] = false;
}

solver::large_motion::IntegrationSummary integrate_tracking(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system,
    const solver::TransientOptions& options, const solver::large_motion::Observer& observe) {
  solver::large_motion::State state = system.reference_state();
  solver::large_motion::IntegrationSummary summary;
  summary.outcome =
      make_consistent(system, state, initial_tracking_velocities(case_model, system), options.step);
  if (!summary.outcome.solved()) return summary;
  const solver::large_motion::ConstrainedSystem& equations = system;
  return integrate(equations, state, options, observe);
}

}  // namespace trammel::harness
