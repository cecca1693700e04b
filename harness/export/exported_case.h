#pragma once

#include <optional>
#include <string>

#include "harness/base/json.h"
#include "harness/input/case.h"
#include "harness/scene/case_model.h"

/// Cases for other codes: one computation each, with all that a case file can leave to be resolved
/// (inheritance, patches, manipulator, pose, meshes, tapers, arcs, effects) resolved.
namespace trammel::harness {

/// Which computation of a case.
struct ExportChoice {
  std::string variant = kBaseVariant;
  std::string sweep = {};  ///< empty: the only one
  std::optional<std::size_t> level = std::nullopt;
};

/// The case, with the variant's and the level's patch.
/// @throws InputError  where there is no such variant, sweep or level.
[[nodiscard]] Document chosen_document(const Case& given, const ExportChoice& choice);

/// The scene as its analysis takes it: with its effects, and no lock where an actuator is driven.
/// @throws InputError  where it is none of plain parts: analyses of no model or of the manipulator
///                     along its path, trajectories.
struct ExportedScene {
  solver::Model model;
  solver::large_motion::LargeMotionModel joints;
  solver::Effects effects = solver::Effects::all();
};
[[nodiscard]] ExportedScene exported_scene(const Document& document);

/// The case file: model, analysis, and under "export" where it is from and which quantities are
/// asked for. The manipulator along its path (kinematics, rigid dynamics, elastodynamics) stays
/// one, and stands there as bodies, joints and a table over time. A network on samples of its own
/// is exported as it is.
/// @throws InputError  as above, and where a case file has no words for a part or a quantity.
[[nodiscard]] Json export_case(const Case& given, const ExportChoice& choice);

}  // namespace trammel::harness
