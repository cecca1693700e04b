#pragma once

#include <array>

#include "solver/model/model.h"

namespace trammel::solver {

/// Shape functions of a side's ends and its middle, and their derivatives, at a fraction of it; the
/// middle has none where the side is linear.
struct SideShape {
  std::array<double, 3> N, dN;
};

[[nodiscard]] SideShape side_shape(bool quadratic, double s);

/// Consistent forces [N] on the nodes of a loaded side, t integral N^T traction ds; the third is
/// zero where the side has no middle node. The side may be curved: it is the parabola through its
/// nodes, and the pressure follows its normal.
[[nodiscard]] std::array<Vector2d, 3> edge_forces(const Model& model, const EdgeLoad& load);

}  // namespace trammel::solver
