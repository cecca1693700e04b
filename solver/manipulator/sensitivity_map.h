#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/frequency_sensitivity.h"

/// The first elastic frequency and its sensitivity over the workspace (paper Fig. 16), and curves
/// in the plane of positions, for one orientation of the platform.
namespace trammel::solver {

/// The first elastic frequency at one pose; NaN unless solved.
struct FirstFrequency {
  Outcome outcome;       ///< as FrequencySensitivity; singular too where all motions are rigid
  Evidence evidence;     ///< of the modes
  double frequency = 0;  ///< [Hz]; has a value at a straight or folded limb, too
  double derivative =
      0;  ///< as the parameter grows; of a repeated frequency the lowest [Hz / unit]
  Counters counters;
};
[[nodiscard]] FirstFrequency first_frequency(const ManipulatorDesign& design,
                                             const DesignParameter& parameter, const Pose& pose);

/// Poses x = x0 + i dx, y = y0 + j dy at one orientation.
struct PoseGrid {
  double x0 = 0, y0 = 0;  ///< [m]
  double dx = 0, dy = 0;  ///< > 0 [m]
  Index columns = 0, rows = 0;
  double phi = 0;  ///< [rad]

  [[nodiscard]] Pose pose(Index row, Index column) const {
    return {x0 + static_cast<double>(column) * dx, y0 + static_cast<double>(row) * dy, phi};
  }
};

/// The grid that just holds all poses within reach of the three limbs, square cells.
[[nodiscard]] PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi,
                                      Index columns);

/// row x column; NaN where there is no value. At a pose on the boundary of the reach, where the
/// derivative is infinite, only the frequency and the distance have values.
struct SensitivityMap {
  PoseGrid grid;
  Eigen::MatrixXd frequency;        ///< f_1 [Hz]
  Eigen::MatrixXd derivative;       ///< d f_1 / dp [Hz / unit], as the parameter grows
  Eigen::MatrixXd serial_distance;  ///< as in Jacobians [-]
  Evidence evidence;                ///< of the modes at all poses with a value
  Counters counters;
};

/// Map of the first elastic frequency over the reachable workspace.
[[nodiscard]] SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                                 const DesignParameter& parameter,
                                                 const PoseGrid& grid);

using Polyline = std::vector<Vector2d>;  ///< (x, y) of P [m]

/// Where the reach ends: arcs on which one limb is straight or folded (serial singularities) and
/// the others are within reach.
/// @param points  of a whole circle.
[[nodiscard]] std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry,
                                                       double phi, Index points);

/// Where det J_x = 0 within reach, as a segment a cell of the grid, from one side of the cell to
/// another; the ends are exact, and the curve is straight in between. Only sides that lie
/// within reach.
[[nodiscard]] std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                                           const PoseGrid& grid);

}  // namespace trammel::solver
