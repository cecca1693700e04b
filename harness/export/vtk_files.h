#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

namespace trammel::harness {

/// Cell of a grid. The type is the cell type of VTK: 3 line, 5 triangle, 7 polygon, 22 six-node
/// triangle.
struct VtkCell {
  std::vector<std::size_t> nodes;
  int type = 0;
  std::ptrdiff_t part = 0;
};

/// Returns an unstructured grid in the plane as the text of a VTU file.
/// @param displacement  displacement of each node [m]; may be empty
[[nodiscard]] std::string vtu(const std::vector<results::Point>& nodes,
                              const std::vector<VtkCell>& cells, const std::string& cell_data_name,
                              const std::vector<results::Point>& displacement = {});

/// Writes the drawings of a run as CASE-VARIANT-shapes.pvd, -poses.pvd and -motion.pvd. These files
/// list one VTU file per mode shape, per pose and per selected time of a motion. The files of a
/// motion are listed with their times [s]. Displaced grids have point vectors "displacement" [m].
/// Writes nothing if the run has no drawing.
/// @throws InputError  if the folder cannot be written.
void write_vtk(const results::Run& run, const std::filesystem::path& folder);

}  // namespace trammel::harness
