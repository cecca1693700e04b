#pragma once

#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large_motion/solve/consistent_initialization.h"
#include "solver/large_motion/system/geometrically_exact_system.h"

/// The manipulator in large motion, its actuators driven as its rigid twin would follow the path.
namespace trammel::harness {

/// Releases the locked actuators of the model and drives them.
/// @param place  "track", for messages
/// @throws InputError  without a trajectory, locked actuators and hinged elbows.
void add_tracking_drives(const JsonView& place, const CaseModel& case_model, solver::Model& model,
                         solver::large_motion::LargeMotionModel& large_motion);

/// Velocities at the start, those of the rigid twin.
[[nodiscard]] solver::large_motion::PrescribedVelocities tracking_start(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system);

}  // namespace trammel::harness
