#pragma once

#include <optional>

#include "harness/scene/drawing.h"
#include "solver/large/geometrically_exact_system.h"

/// Pictures of models in large motion: places, never magnified.
namespace trammel::harness {

/// The model in its own pose; nothing where there are more nodes than a picture can show.
[[nodiscard]] std::optional<Drawing> draw_large_model(
    const solver::large_motion::GeometricallyExactSystem& system, bool is_manipulator);

/// Where the drawing's nodes are at coordinates q.
[[nodiscard]] results::Pose draw_large_pose(
    const solver::large_motion::GeometricallyExactSystem& system, const Eigen::VectorXd& q,
    const std::string& label);

}  // namespace trammel::harness
