#pragma once

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Adds the drives of a large-statics or large-motion analysis, and of the second its damping, its
/// history of the loads and its start.
/// @throws InputError  where a name leads nowhere.
void read_drives(const JsonView& analysis, const solver::Model& built,
                 solver::large_motion::LargeMotionModel& large_motion);
void read_history(const JsonView& analysis, const solver::Model& built,
                  solver::large_motion::LargeMotionModel& large_motion);

/// A motion over time: place, speed and acceleration.
[[nodiscard]] solver::large_motion::TimeFunction read_law(const JsonView& law);

/// The node of that name. @throws InputError  where there is none.
[[nodiscard]] solver::Index find_node(const JsonView& name, const solver::Model& built);

}  // namespace trammel::harness
