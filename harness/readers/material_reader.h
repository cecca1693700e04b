#pragma once

#include "harness/input/json_view.h"
#include "solver/model/model.h"

/// Words and numbers that manipulators and frames have in common.
namespace trammel::harness {

[[nodiscard]] Eigen::Vector2d read_point(const JsonView& point);

/// "force_N" and "moment_N_m" of a load, each nothing where it is missing.
[[nodiscard]] Eigen::Vector3d read_force(const JsonView& load);
[[nodiscard]] solver::Material read_material(const JsonView& material);
[[nodiscard]] solver::BeamTheory read_beam_theory(const JsonView& part);  ///< key "beam"
[[nodiscard]] solver::MassMatrix read_mass_matrix(const JsonView& part);  ///< key "mass_matrix"
[[nodiscard]] bool read_axial(const JsonView& part);                      ///< key "axial"

}  // namespace trammel::harness
