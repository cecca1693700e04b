#pragma once

#include "harness/input/json_view.h"
#include "solver/large_motion/system/large_motion_model.h"
#include "solver/model/model.h"

namespace trammel {

/// Reads /model/sliders, line_springs and follower_loads.
/// @param model  the place /model
/// @param built  what the names of nodes are looked up in
/// @throws InputError  where a name leads nowhere.
[[nodiscard]] large::Scenario read_mechanism(const Cursor& model, const Model& built);

/// Adds the drives of a large-statics or large-motion analysis, and of the second its damping, its
/// history of the loads and its start.
/// @throws InputError  where a name leads nowhere.
void read_drives(const Cursor& analysis, const Model& built, large::Scenario& scenario);
void read_history(const Cursor& analysis, const Model& built, large::Scenario& scenario);

/// A motion over time: place, speed and acceleration.
[[nodiscard]] large::TimeFunction read_law(const Cursor& law);

/// The node of that name. @throws InputError  where there is none.
[[nodiscard]] Index find_node(const Cursor& name, const Model& built);

}  // namespace trammel
