#pragma once

#include "harness/input/json_view.h"
#include "solver/manipulator/trajectory.h"

namespace trammel::harness {

/// A path, and its points at the times 0, step, 2 step, ...
struct Trajectory {
  solver::Path path;
  std::vector<solver::TrajectoryPoint> motion;
};

/// Reads /model/trajectory: a circle, a line, a motion from rest to rest, or a spline through
/// poses.
/// @throws InputError  where the path has no meaning, or its points go beyond the spline's last.
[[nodiscard]] Trajectory read_trajectory(const JsonView& trajectory);

}  // namespace trammel::harness
