#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/frequency_sensitivity.h"

/// First elastic frequency and its sensitivity over the workspace (paper Fig. 16), and singularity
/// curves. All refer to one orientation of the platform.
namespace trammel::solver {

/// First elastic frequency at one pose; NaN unless solved.
struct FirstFrequency {
  Outcome outcome;       ///< as FrequencySensitivity; also singular if all modes are rigid
  Evidence evidence;     ///< residuals of the modes
  double frequency = 0;  ///< [Hz]; also defined if a limb is straight or folded
  double derivative =
      0;  ///< for an increasing parameter; the lowest for a repeated frequency [Hz / unit]
  Counters counters;
};
/// Computes the first elastic frequency and its derivative.
[[nodiscard]] FirstFrequency first_frequency(const ManipulatorDesign& design,
                                             const DesignParameter& parameter, const Pose& pose);

/// Grid of poses x = x0 + i dx, y = y0 + j dy at one orientation.
struct PoseGrid {
  double x0 = 0, y0 = 0;  ///< [m]
  double dx = 0, dy = 0;  ///< > 0 [m]
  Index columns = 0, rows = 0;
  double phi = 0;  ///< [rad]

  [[nodiscard]] Pose pose(Index row, Index column) const {
    return {x0 + static_cast<double>(column) * dx, y0 + static_cast<double>(row) * dy, phi};
  }
};

/// Returns the smallest grid of square cells that contains all poses within reach of the three
/// limbs.
[[nodiscard]] PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi,
                                      Index columns);

/// Map of the first frequency, row x column; NaN without a value. On the boundary of the workspace
/// the derivative is infinite, and only the frequency and the distance have values.
struct SensitivityMap {
  PoseGrid grid;
  Eigen::MatrixXd frequency;        ///< f_1 [Hz]
  Eigen::MatrixXd derivative;       ///< d f_1 / dp [Hz / unit] for an increasing parameter
  Eigen::MatrixXd serial_distance;  ///< as in Jacobians [-]
  Evidence evidence;                ///< residuals of the modes at all poses with a value
  Counters counters;
};

/// Computes the map of the first elastic frequency over the reachable workspace.
[[nodiscard]] SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                                 const DesignParameter& parameter,
                                                 const PoseGrid& grid);

using Polyline = std::vector<Vector2d>;  ///< (x, y) of P [m]

/// Returns the boundary of the workspace. It consists of arcs on which one limb is straight or
/// folded (serial singularities) and the others are within reach.
/// @param geometry  dimensions.
/// @param phi  orientation of the platform [rad].
/// @param points  number of points on a full circle.
[[nodiscard]] std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry,
                                                       double phi, Index points);

/// Returns the curves with det J_x = 0 within reach, as one segment per grid cell between two sides
/// of the cell. The ends are exact, and the curve is approximated by straight lines. Only cell
/// sides within reach are searched.
[[nodiscard]] std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                                           const PoseGrid& grid);

}  // namespace trammel::solver
