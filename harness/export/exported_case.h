#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/case.h"
#include "harness/scene/case_model.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"

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

/// Writes the linear matrices of a scene (of large ones at no load) into a folder: K.mtx and M.mtx
/// of the free coordinates q, C.mtx where the analysis has Rayleigh damping, T.mtx with u = T q,
/// f.mtx (loads on q), coordinates.csv (what each of u is) and mesh.vtu. Matrix Market, symmetric
/// ones as their lower triangles; SI.
/// @throws InputError  where the folder cannot be written, or springs along a line or follower
///                     loads have no matrices.
void write_matrices(const Document& document, const ExportedScene& scene,
                    const std::filesystem::path& folder);

/// A built model as a case file says it, with nothing left to resolve: every node has a name,
/// sections have numbers, what was tapered is a chain of uniform members, and what was spread over
/// edges stands at nodes.

/// Names that a built model has lost.
struct WrittenNames {
  std::vector<std::pair<std::string, solver::Material>> materials;
  std::vector<std::string> loads;  ///< of the first `Model::loads`
};

/// The value of a case's "model".
/// @param model  without the linear constraints of its sliders, which `joints` has
/// @throws ModelError  where a case file has no words for a part, or two have one name.
[[nodiscard]] Json model_json(solver::Model model,
                              const solver::large_motion::LargeMotionModel& joints,
                              const WrittenNames& names);

/// Whether the member's section varies along it.
[[nodiscard]] bool is_tapered(const solver::Member& member);

}  // namespace trammel::harness
