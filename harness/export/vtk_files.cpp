#include "harness/export/vtk_files.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "harness/base/json_file.h"

namespace trammel::harness {
namespace {

using results::Point;

constexpr int kLine = 3, kPolygon = 7;

std::string array(const char* type, const std::string& name, int components,
                  const std::string& data) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}"
      "</DataArray>\n",
      type, name, components, data);
}

std::string vectors(const std::vector<Point>& points) {
  std::string text;
  for (const auto& [x, y] : points)
    fmt::format_to(std::back_inserter(text), "{} {} 0\n", std::isfinite(x) ? x : 0,
                   std::isfinite(y) ? y : 0);
  return text;
}

std::vector<VtkCell> vtk_cells_of_drawing(const results::Drawing& drawing) {
  std::vector<VtkCell> cells;
  for (const auto& member : drawing.members)
    cells.push_back({{member.begin(), member.end()}, kLine, 0});
  for (const auto& triangle : drawing.triangles)
    cells.push_back({{triangle.begin(), triangle.end()}, kPolygon, 1});
  return cells;
}

struct Grid {
  std::string label, text;
  double time = 0;
};

/// Writes a PVD file and the VTU files that it lists.
void write_vtk_collection(const std::filesystem::path& folder, const std::string& name,
                          const std::vector<Grid>& grids) {
  if (grids.empty()) return;
  std::string sets;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const std::string file = fmt::format("{}-{}.vtu", name, i + 1);
    write_file(folder / file, grids[i].text);
    sets += fmt::format("<!-- {} -->\n<DataSet timestep=\"{}\" file=\"{}\"/>\n", grids[i].label,
                        grids[i].time, file);
  }
  write_file(
      folder / (name + ".pvd"),
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
          sets + "</Collection>\n</VTKFile>\n");
}

}  // namespace

std::string vtu(const std::vector<Point>& nodes, const std::vector<VtkCell>& cells,
                const std::string& cell_data_name, const std::vector<Point>& displacement) {
  std::string connectivity, offsets, types, parts;
  std::size_t last = 0;
  for (const VtkCell& cell : cells) {
    connectivity += fmt::format("{}\n", fmt::join(cell.nodes, " "));
    offsets += std::to_string(last += cell.nodes.size()) + "\n";
    types += std::to_string(cell.type) + "\n";
    parts += std::to_string(cell.part) + "\n";
  }
  const std::string moved = displacement.empty()
                                ? ""
                                : "<PointData Vectors=\"displacement\">\n" +
                                      array("Float64", "displacement", 3, vectors(displacement)) +
                                      "</PointData>\n";
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "{}<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n<CellData>\n{}</CellData>\n"
      "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      nodes.size(), cells.size(), moved, array("Float64", "points", 3, vectors(nodes)),
      array("Int64", "connectivity", 1, connectivity), array("Int64", "offsets", 1, offsets),
      array("UInt8", "types", 1, types), array("Int64", cell_data_name, 1, parts));
}

void write_vtk(const results::Run& run, const std::filesystem::path& folder) {
  if (!run.drawing) return;
  const results::Drawing& drawing = *run.drawing;
  const std::vector<VtkCell> cells = vtk_cells_of_drawing(drawing);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::vector<Grid> shapes, poses, moments;
  const auto number_of = [](const auto& grids) { return static_cast<double>(grids.size() + 1); };
  for (const results::Shape& shape : drawing.shapes)
    shapes.push_back({shape.label, vtu(drawing.nodes, cells, "is_plate", shape.displacement),
                      number_of(shapes)});
  poses.push_back({"first", vtu(drawing.nodes, cells, "is_plate"), 1});
  for (const results::Pose& pose : drawing.poses) {
    std::vector<Grid>& grids = pose.time_s ? moments : poses;
    grids.push_back({pose.label, vtu(pose.nodes, cells, "is_plate", pose.displacement),
                     pose.time_s.value_or(number_of(grids))});
  }
  const std::string name = run.case_id + "-" + run.variant;
  write_vtk_collection(folder, name + "-shapes", shapes);
  write_vtk_collection(folder, name + "-poses", poses);
  write_vtk_collection(folder, name + "-motion", moments);
}

}  // namespace trammel::harness
