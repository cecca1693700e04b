#pragma once

#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large_motion/solve/consistent_initialization.h"
#include "solver/large_motion/system/geometrically_exact_system.h"

/// The manipulator in large motion, its actuators driven as its rigid twin would follow the path.
namespace trammel::harness {

/// Drives the actuators along the trajectory.
/// @throws InputError  without a trajectory that lasts to the end, locked actuators and hinged
///                     elbows.
void add_tracking_drives(const JsonView& analysis, const CaseModel& case_model,
                         const solver::Model& model,
                         solver::large_motion::LargeMotionModel& large_motion);

/// Takes away what holds the actuators that are driven.
/// @throws InputError  where one is free: no link is joined to it.
void release_driven_actuators(const JsonView& analysis, const CaseModel& case_model,
                              const solver::large_motion::LargeMotionModel& large_motion,
                              solver::Model& model);

/// Velocities at the start, those of the rigid twin.
[[nodiscard]] solver::large_motion::PrescribedVelocities tracking_start(
    const CaseModel& case_model, const solver::large_motion::GeometricallyExactSystem& system);

}  // namespace trammel::harness
