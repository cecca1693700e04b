#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// Files that VTK and ParaView read.
namespace trammel::harness {

/// Types are VTK's numbers: 3 line, 5 triangle, 7 polygon, 22 triangle with the middles of its
/// sides.
struct VtkCell {
  std::vector<std::size_t> nodes;
  int type = 0;
  std::ptrdiff_t part = 0;
};

/// An unstructured grid in the plane as VTU.
/// @param displacement  one a node [m]; or none
[[nodiscard]] std::string vtu(const std::vector<results::Point>& nodes,
                              const std::vector<VtkCell>& cells, const std::string& part,
                              const std::vector<results::Point>& displacement = {});

/// What is drawn of a run: CASE-VARIANT-shapes.pvd, -poses.pvd and -motion.pvd, which name a VTU
/// file for each shape, pose and moment of a motion, these by their time [s]; what is displaced
/// has point vectors "displacement" [m]. Nothing where nothing is drawn.
/// @throws InputError  where the folder cannot be written.
void write_vtk(const results::Run& run, const std::filesystem::path& folder);

}  // namespace trammel::harness
