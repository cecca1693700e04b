#include "harness/export/matrix_files.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

#include "harness/analysis/analysis.h"
#include "harness/base/json_file.h"
#include "harness/readers/damping_reader.h"
#include "harness/scene/with_model_errors.h"
#include "solver/assembly/damping.h"
#include "solver/assembly/system.h"
#include "solver/large_motion/elements/linear_joints.h"

namespace trammel::harness {
namespace {

using solver::Index;
using solver::SparseMatrix;

std::string matrix_market(const SparseMatrix& matrix, bool symmetric, const char* what) {
  std::string entries;
  std::size_t count = 0;
  for (Index column = 0; column < matrix.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(matrix, column); it; ++it) {
      if (it.value() == 0 || (symmetric && it.row() < it.col())) continue;
      fmt::format_to(std::back_inserter(entries), "{} {} {}\n", it.row() + 1, it.col() + 1,
                     it.value());
      ++count;
    }
  }
  return fmt::format("%%MatrixMarket matrix coordinate real {}\n% {}\n{} {} {}\n",
                     symmetric ? "symmetric" : "general", what, matrix.rows(), matrix.cols(),
                     count) +
         entries;
}

/// A line for each of u: its number from 1, the motion, and the node or the member's end.
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
  for (std::size_t m = 0; m < system.coordinates.member_end.size(); ++m) {
    for (std::size_t end = 0; end < 2; ++end) {
      set(system.coordinates.member_end[m][end], "end_rotation_rad",
          system.model.members[m].name + (end == 0 ? ".start" : ".end"));
    }
  }
  std::string text = "coordinate,motion,of\n";
  for (const std::string& line : lines) text += line;
  return text;
}

/// Cells in VTK's numbers: 3 line, 5 triangle, 22 triangle with the middles of its sides.
std::string vtu(const solver::System& system) {
  std::string points, connectivity, offsets, types, parts;
  std::size_t cells = 0, last = 0;
  const auto add = [&](const auto& nodes, std::size_t count, int type, Index part) {
    for (std::size_t i = 0; i < count; ++i)
      connectivity += std::to_string(nodes[i]) + (i + 1 < count ? " " : "\n");
    offsets += std::to_string(last += count) + "\n";
    types += std::to_string(type) + "\n";
    parts += std::to_string(part) + "\n";
    ++cells;
  };
  for (const Eigen::Vector2d& p : system.mesh.positions)
    fmt::format_to(std::back_inserter(points), "{} {} 0\n", p.x(), p.y());
  for (const solver::FrameElement& e : system.mesh.frame) add(e.nodes, 2, 3, e.member);
  for (const solver::Triangle& triangle : system.model.triangles)
    add(triangle.nodes, triangle.quadratic() ? 6 : 3, triangle.quadratic() ? 22 : 5,
        triangle.plate);
  const auto array = [](const char* type, const char* name, int components,
                        const std::string& data) {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}"
        "</DataArray>\n",
        type, name, components, data);
  };
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n<CellData>\n{}</CellData>\n"
      "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      system.mesh.positions.size(), cells, array("Float64", "points", 3, points),
      array("Int64", "connectivity", 1, connectivity), array("Int64", "offsets", 1, offsets),
      array("UInt8", "types", 1, types), array("Int64", "member_or_plate", 1, parts));
}

}  // namespace

void write_matrices(const Document& document, const ExportedScene& scene,
                    const std::filesystem::path& folder) {
  const solver::System system = with_model_errors(document, [&] {
    solver::require(scene.joints.line_springs.empty() && scene.joints.follower_loads.empty(),
                    "line springs and follower loads have no matrices");
    solver::Model model = scene.model;
    for (const auto& slider : scene.joints.sliders) solver::add_linear_slider(model, slider);
    return solver::assemble(model, scene.effects);
  });
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  write_file(folder / "K.mtx", matrix_market(system.K, true, "stiffness of q [SI]"));
  if (system.M.size() > 0)
    write_file(folder / "M.mtx", matrix_market(system.M, true, "mass of q [SI]"));
  const std::string kind = analysis_kind(document);
  if (kind == "transient" || kind == "harmonic") {
    const solver::RayleighDamping rayleigh =
        read_damping(JsonView(document)["analysis"][kind], system.K.rows()).rayleigh;
    if (rayleigh.mass != 0 || rayleigh.stiffness != 0) {
      const SparseMatrix C = solver::damping_matrix(rayleigh, system.M, system.K);
      write_file(folder / "C.mtx", matrix_market(C, true, "Rayleigh damping of q [SI]"));
    }
  }
  write_file(folder / "T.mtx", matrix_market(system.T, false, "u = T q"));
  write_file(folder / "f.mtx", matrix_market(system.f.sparseView(), false, "loads on q [N, N m]"));
  write_file(folder / "coordinates.csv", coordinate_table(system));
  write_file(folder / "mesh.vtu", vtu(system));
}

}  // namespace trammel::harness
