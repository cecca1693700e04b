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

/// Exports cases for other codes, as one computation each. The exported case contains explicit
/// nodes, members, loads and effects instead of inheritance, patches, mesh options, tapers and
/// arcs. A manipulator at rest is also replaced by its nodes and members.
namespace trammel::harness {

/// Variant and refinement level of a case, which select one computation.
struct ExportChoice {
  std::string variant = kBaseVariant;
  std::string sweep = {};  ///< name of the sweep; empty: the only sweep of the case
  std::optional<std::size_t> level = std::nullopt;
};

/// Returns the case with the patches of the chosen variant and of the chosen level of a sweep.
/// @throws InputError  if the variant, sweep or level does not exist.
[[nodiscard]] Document case_with_chosen_patches(const Case& given, const ExportChoice& choice);

/// Model of a case for export, with the effects of its analysis. Actuators that follow a prescribed
/// motion have no support against rotation.
struct ExportedScene {
  solver::Model model;
  solver::large_motion::LargeMotionModel joints;
  solver::Effects effects = solver::Effects::all();
};
[[nodiscard]] ExportedScene exported_scene(const Document& document);

/// Returns the exported case file: model, analysis, and the key "export" with the origin of the
/// case and the requested quantities. The manipulator along its path (kinematics, rigid dynamics,
/// elastodynamics) is exported unchanged. Bodies, joints and a table of the path over time are
/// added under "export". The case of a neural network whose samples are stated in the case is
/// exported unchanged.
/// @throws InputError  under the conditions of `exported_scene`, and if a case file cannot express
///   a part or a quantity.
[[nodiscard]] Json export_case(const Case& given, const ExportChoice& choice);

/// Writes the linear matrices of a case into a folder. A case with large displacement is linearized
/// about the unloaded state.
///   K.mtx, M.mtx      stiffness and mass matrix for the free coordinates q.
///   C.mtx             Rayleigh damping matrix, if the analysis has Rayleigh damping.
///   T.mtx             matrix that yields all coordinates u = T q.
///   f.mtx             loads on the free coordinates q.
///   coordinates.csv   motion and node of each coordinate in u.
///   mesh.vtu          finite element mesh.
///
/// The format is Matrix Market in SI units. Symmetric matrices are stored as their lower triangles.
/// @throws InputError  if the folder cannot be written, or for springs along a line and follower
///   loads, which have no matrices.
void write_system_matrices(const Document& document, const ExportedScene& scene,
                           const std::filesystem::path& folder);

/// Converts a built model into the format of a case file in which all values are explicit. Every
/// node has a name, and every section is given by numbers. Tapered members become chains of uniform
/// members, and edge loads become nodal loads.

/// Names of materials and loads in the case, which a built model does not contain.
struct WrittenNames {
  std::vector<std::pair<std::string, solver::Material>> materials;
  std::vector<std::string> loads;  ///< names of the first loads in `Model::loads`
};

/// Returns a model in the form of the key "model" of a case file.
/// @param model  model without the linear constraints of sliders, which `joints` contains
/// @throws ModelError  if a case file cannot express a part, or two parts have the same name.
[[nodiscard]] Json model_json(solver::Model model,
                              const solver::large_motion::LargeMotionModel& joints,
                              const WrittenNames& names);

/// Returns true if the member's section varies along its length.
[[nodiscard]] bool is_tapered(const solver::Member& member);

}  // namespace trammel::harness
