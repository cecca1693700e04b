#pragma once

#include "harness/input/json_view.h"
#include "solver/model/model.h"

/// Words and numbers that manipulators and frames have in common.
namespace trammel {

[[nodiscard]] Vector2d read_point(const JsonView& point);
[[nodiscard]] Material read_material(const JsonView& material);
[[nodiscard]] BeamTheory read_beam_theory(const JsonView& part);  ///< key "beam"
[[nodiscard]] MassMatrix read_mass_matrix(const JsonView& part);  ///< key "mass_matrix"
[[nodiscard]] bool read_axial(const JsonView& part);              ///< key "axial"

}  // namespace trammel
