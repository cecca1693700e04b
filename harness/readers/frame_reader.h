#pragma once

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// The planar part of a case's model.
struct Structure {
  solver::Model model;
  /// Sliders, springs along a line and follower loads.
  solver::large_motion::LargeMotionModel joints;
};

/// Reads the nodes of a planar model and what joins them. Indices count `before` first.
/// @param model   the place /model
/// @param before  nodes that are already there, from the manipulator
/// @throws InputError  where a name leads nowhere or geometry is impossible.
[[nodiscard]] Structure read_structure(const JsonView& model,
                                       const std::vector<solver::Node>& before);

}  // namespace trammel::harness
