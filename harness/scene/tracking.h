#pragma once

#include "harness/base/recorder.h"
#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/large/integrate_large_motion.h"

/// Makes the manipulator in large motion follow a path. Its rigid twin is the same manipulator with
/// rigid links, which follows the path exactly. The actuators rotate like those of the rigid twin,
/// or apply the torques that the rigid twin requires.
namespace trammel::harness {

/// Data of the rigid twin (manipulator with rigid links) that are applied to the actuators: their
/// angles, or the torques of inverse dynamics under the same loads.
enum class Tracking { angles, torques };

/// Prescribes the rotations of the actuators that follow the trajectory, or applies the torques of
/// the rigid twin to the actuators.
/// @param place  the object of the case that requests tracking
/// @throws InputError  if the case lacks a trajectory, locked actuators, hinged elbows or hinged
///   platform joints. For torques, also if the case has parts that rigid dynamics would ignore.
void add_tracking(const JsonView& place, Tracking tracking, const CaseModel& case_model,
                  const solver::Model& model, solver::large_motion::LargeMotionModel& large_motion);

void record_actuator_drives(const solver::large_motion::GeometricallyExactSystem& system,
                            const solver::large_motion::State& state, Recorder& record);

/// Removes the supports that lock actuators, if a prescribed motion or a torque acts on these
/// actuators.
/// @throws InputError  if a drive prescribes the rotation of a free actuator, because no link is
///   attached to this rotation.
void release_driven_actuators(const JsonView& analysis, const CaseModel& case_model,
                              const solver::large_motion::LargeMotionModel& large_motion,
                              solver::Model& model);

/// Integrates the motion from the model's pose. The initial velocities are those of the rigid twin
/// (manipulator with rigid links).
[[nodiscard]] solver::large_motion::IntegrationSummary integrate_tracking(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system,
    const solver::TransientOptions& options, const solver::large_motion::Observer& observe);

}  // namespace trammel::harness
