#include <fmt/format.h>

#include <array>
#include <iterator>

#include "harness/analysis/analysis.h"
#include "harness/base/json_file.h"
#include "harness/export/exported_case.h"
#include "harness/export/vtk_files.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/rethrow_as_input.h"
#include "solver/large/large_motion_model.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/system.h"

namespace trammel::harness {
namespace {

using solver::Index;
using solver::SparseMatrix;

std::string matrix_market(const SparseMatrix& matrix, bool symmetric, const char* what) {
  std::string entries;
  std::size_t count = 0;
  for (Index column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator it(matrix, column); it; ++it) {
      if (it.value() == 0 || (symmetric && it.row() < it.col())) continue;
      fmt::format_to(std::back_inserter(entries), "{} {} {}\n", it.row() + 1, it.col() + 1,
                     it.value());
      ++count;
    }
  return fmt::format("%%MatrixMarket matrix coordinate real {}\n% {}\n{} {} {}\n",
                     symmetric ? "symmetric" : "general", what, matrix.rows(), matrix.cols(),
                     count) +
         entries;
}

/// Returns a CSV line for each coordinate in u: number (from 1), kind of motion, and node or member
/// end.
std::string coordinate_table(const solver::System& system) {
  std::vector<std::string> lines(solver::to_size(system.coordinates.size));
  const auto set = [&](Index number, const char* motion, const std::string& of) {
    if (number >= 0)
      lines[solver::to_size(number)] = fmt::format("{},{},\"{}\"\n", number + 1, motion, of);
  };
  const auto named = static_cast<Index>(system.model.nodes.size());
  for (std::size_t node = 0; node < system.coordinates.node.size(); ++node) {
    const auto i = static_cast<Index>(node);
    const std::string of = i < named && !system.model.nodes[node].name.empty()
                               ? system.model.nodes[node].name
                               : fmt::format("point {}", node);
    for (std::size_t k = 0; k < 3; ++k)
      set(system.coordinates.node[node][k], std::array{"x_m", "y_m", "rotation_rad"}[k], of);
  }
  for (std::size_t m = 0; m < system.coordinates.member_end.size(); ++m)
    for (std::size_t end = 0; end < 2; ++end)
      set(system.coordinates.member_end[m][end], "end_rotation_rad",
          system.model.members[m].name + (end == 0 ? ".start" : ".end"));
  std::string text = "coordinate,motion,of\n";
  for (const std::string& line : lines) text += line;
  return text;
}

std::string mesh_text(const solver::System& system) {
  std::vector<results::Point> nodes;
  for (const Eigen::Vector2d& p : system.mesh.positions) nodes.emplace_back(p.x(), p.y());
  std::vector<VtkCell> cells;
  for (const solver::FrameElement& e : system.mesh.frame)
    cells.push_back({{e.nodes.begin(), e.nodes.end()}, 3, e.member});
  for (const solver::Triangle& triangle : system.model.triangles) {
    const auto end = triangle.nodes.begin() + (triangle.quadratic() ? 6 : 3);
    cells.push_back({{triangle.nodes.begin(), end}, triangle.quadratic() ? 22 : 5, triangle.plate});
  }
  return vtu(nodes, cells, "member_or_plate");
}

}  // namespace

void write_system_matrices(const Document& document, const ExportedScene& scene,
                           const std::filesystem::path& folder) {
  const solver::System system = rethrow_as_input_error(document, [&] {
    solver::require(scene.joints.line_springs.empty() && scene.joints.follower_loads.empty(),
                    "line springs and follower loads have no matrices");
    solver::Model model = scene.model;
    for (const auto& slider : scene.joints.sliders) solver::add_small_motion_slider(model, slider);
    return solver::assemble(model, scene.effects);
  });
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  write_file(folder / "K.mtx", matrix_market(system.K, true, "stiffness matrix for q [SI]"));
  if (system.M.size() > 0)
    write_file(folder / "M.mtx", matrix_market(system.M, true, "mass matrix for q [SI]"));
  const std::string kind = analysis_kind(document);
  if (kind == "transient" || kind == "harmonic") {
    const solver::RayleighDamping rayleigh =
        read_damping(JsonView(document)["analysis"][kind], system.K.rows()).rayleigh;
    if (rayleigh.mass != 0 || rayleigh.stiffness != 0) {
      const SparseMatrix C = solver::damping_matrix(rayleigh, system.M, system.K);
      write_file(folder / "C.mtx", matrix_market(C, true, "Rayleigh damping matrix [SI]"));
    }
  }
  write_file(folder / "T.mtx", matrix_market(system.T, false, "matrix T of u = T q"));
  write_file(folder / "f.mtx", matrix_market(system.f.sparseView(), false, "loads on q [N, N m]"));
  write_file(folder / "coordinates.csv", coordinate_table(system));
  write_file(folder / "mesh.vtu", mesh_text(system));
}

}  // namespace trammel::harness
