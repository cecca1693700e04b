#pragma once

#include "harness/input/json_view.h"
#include "solver/model/model.h"

/// Words and numbers that manipulators and frames have in common.
namespace trammel::harness {

[[nodiscard]] Eigen::Vector2d read_point(const JsonView& point);
[[nodiscard]] solver::Material read_material(const JsonView& material);
[[nodiscard]] solver::BeamTheory read_beam_theory(const JsonView& part);  ///< key "beam"
[[nodiscard]] solver::MassMatrix read_mass_matrix(const JsonView& part);  ///< key "mass_matrix"
[[nodiscard]] bool read_axial(const JsonView& part);                      ///< key "axial"

}  // namespace trammel::harness
