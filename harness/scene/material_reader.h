#pragma once

#include "harness/input/json_view.h"
#include "solver/model/model.h"

/// Words and numbers that manipulators and frames have in common.
namespace trammel {

[[nodiscard]] Vector2d read_point(const Cursor& point);
[[nodiscard]] Material read_material(const Cursor& material);
[[nodiscard]] BeamTheory read_beam_theory(const Cursor& part);  ///< key "beam"
[[nodiscard]] MassMatrix read_mass_matrix(const Cursor& part);  ///< key "mass_matrix"
[[nodiscard]] bool read_axial(const Cursor& part);              ///< key "axial"

}  // namespace trammel
