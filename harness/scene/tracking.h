#pragma once

#include "harness/base/recorder.h"
#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/large/integrate_large_motion.h"

/// The manipulator in large motion, its actuators driven as its rigid twin follows the path, or
/// under the torques that this one needs for it.
namespace trammel::harness {

/// What is taken from the rigid twin: the angles of its actuators, or the torques of its inverse
/// dynamics under the same loads.
enum class Tracking { angles, torques };

/// Drives the actuators along the trajectory, or applies torques to them.
/// @param place  of the case, where it asks for it
/// @throws InputError  without a trajectory, locked actuators and hinged elbows and platform
/// joints;
///                     for torques, where rigid dynamics would leave something out.
void add_tracking(const JsonView& place, Tracking tracking, const CaseModel& case_model,
                  const solver::Model& model, solver::large_motion::LargeMotionModel& large_motion);

/// Records the torques and forces of the drives.
void record_drives(const solver::large_motion::GeometricallyExactSystem& system,
                   const solver::large_motion::State& state, Recorder& record);

/// Takes away what holds the actuators that are driven or under a torque.
/// @throws InputError  where one is free: no link is joined to it.
void release_driven_actuators(const JsonView& analysis, const CaseModel& case_model,
                              const solver::large_motion::LargeMotionModel& large_motion,
                              solver::Model& model);

/// The motion from the model's pose on, with the velocities of the rigid twin.
[[nodiscard]] solver::large_motion::IntegrationSummary integrate_tracking(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system,
    const solver::TransientOptions& options, const solver::large_motion::Observer& look);

}  // namespace trammel::harness
