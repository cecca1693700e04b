#pragma once

#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/figures/outline.h"

/// What a page's script needs to move a drawing, as JSON: a panel, in tenths of a unit of the
/// drawing, y downwards, with the lines through the nodes that are drawn.
namespace trammel::reports {

inline constexpr double kDrawnAmplitude = 0.13;  ///< of the longer side: deflections magnified

[[nodiscard]] bool are_finite(const std::vector<Point>& points);

/// Modes to swing, a panel each: displacements as they are drawn.
/// @param factor  of each shape
/// @param panel   its width [px]
[[nodiscard]] std::string moving_modes(const Drawing& drawing, const std::vector<double>& factor,
                                       const Box& box, double panel);

/// Moments of a motion: places at rest (only where they differ) and displaced, each less those of
/// the moment before.
/// @param moments  with times
[[nodiscard]] std::string moving_poses(const Drawing& drawing, const std::vector<Pose>& moments,
                                       double factor, const Box& box, double panel);

}  // namespace trammel::reports
