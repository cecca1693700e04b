#pragma once

#include "solver/large_motion/elements/large_motion_model.h"
#include "solver/model/model.h"

namespace trammel::solver {

/// Adds a revolute joint between two coincident nodes, in every tier: equal translations.
void add_pin(Model& model, const std::string& name, const std::array<Index, 2>& nodes);

/// A slider in small motion, for the linear tiers: no displacement across the line as the rail
/// carries it, n . (u - u_rail) = n . (k x (p - p_rail)) theta_rail.
void add_linear_slider(Model& model, const large_motion::Slider& slider);

}  // namespace trammel::solver
