#pragma once

#include <optional>
#include <vector>

#include "harness/input/json_view.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"

namespace trammel::harness {

/// Reads the place /model/manipulator.
/// @throws InputError  where its geometry has no meaning.
[[nodiscard]] solver::ManipulatorDesign read_manipulator(const JsonView& manipulator);

/// One pose at rest, or the points of a path.
struct PlatformMotion {
  std::optional<solver::Path> path;
  std::vector<solver::TrajectoryPoint> points;
};

/// Reads /model/pose or /model/trajectory.
/// @param model  the place /model
/// @throws InputError  where a pose is out of reach.
[[nodiscard]] PlatformMotion read_platform_motion(const JsonView& model,
                                                  const solver::ManipulatorGeometry& geometry);

}  // namespace trammel::harness
