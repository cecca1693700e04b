#pragma once

#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/large_motion/solve/consistent_initialization.h"

/// The manipulator in large motion, its actuators driven as its rigid twin would follow the path.
namespace trammel {

/// Releases the locked actuators of the model and drives them.
/// @param place  "track", for messages
/// @throws InputError  without a trajectory, locked actuators and hinged elbows.
void add_tracking_drives(const JsonView& place, const CaseModel& case_model, Model& model, large::LargeMotionModel& large_motion);

/// Velocities at the start, those of the rigid twin.
[[nodiscard]] large::PrescribedVelocities tracking_start(const CaseModel& case_model,
                                                    const large::GeometricallyExactSystem& system);

}  // namespace trammel
