#pragma once

#include <array>
#include <functional>

#include "solver/model/model.h"

namespace trammel::solver {

/// Force per area [Pa] times |dx/ds| at a position [m] on a side with tangent dx/ds.
using SideLoad = std::function<Vector2d(const Vector2d& position, const Vector2d& tangent)>;

/// Consistent forces [N] on the nodes of a loaded side of a plate, t integral N^T load ds over
/// 0 <= s <= 1; the third is zero where the side has no middle node (-1). The side may be curved:
/// it is the parabola through its nodes.
[[nodiscard]] std::array<Vector2d, 3> side_forces(const Model& model, Index plate,
                                                  const std::array<Index, 3>& nodes,
                                                  const SideLoad& load);

/// The same of a uniform load, whose pressure follows the normal.
[[nodiscard]] std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load);

}  // namespace trammel::solver
