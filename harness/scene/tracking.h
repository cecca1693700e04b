#pragma once

#include "harness/input/json_view.h"
#include "harness/scene/case_model.h"
#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/large_motion/solve/start.h"

/// The manipulator in large motion, its actuators driven as its rigid twin would follow the path.
namespace trammel {

/// Releases the locked actuators of the model and drives them.
/// @param place  "track", for messages
/// @throws InputError  without a trajectory, locked actuators and hinged elbows.
void track(const Cursor& place, const Scene& scene, Model& model, large::Scenario& scenario);

/// Velocities at the start, those of the rigid twin.
[[nodiscard]] large::GivenVelocities tracking_start(const Scene& scene,
                                                    const large::LargeSystem& system);

}  // namespace trammel
