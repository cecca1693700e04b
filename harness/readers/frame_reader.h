#pragma once

#include "harness/input/json_view.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Reads the nodes of a planar model and what joins them. Indices count `before` first.
/// @param model   the place /model
/// @param before  nodes that are already there, from the manipulator
/// @throws InputError  where a name leads nowhere or geometry is impossible.
[[nodiscard]] solver::Model read_structure(const JsonView& model,
                                           const std::vector<solver::Node>& before);

}  // namespace trammel::harness
