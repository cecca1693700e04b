#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/frequency_sensitivity.h"

/// First elastic frequency and its derivative by a design parameter over the workspace (Varalakshmi
/// & Srinivas 2017, Fig. 16), and singularity curves. All results are for one orientation of the
/// platform.
namespace trammel::solver {

/// First elastic frequency at one pose; NaN unless solved.
struct FirstFrequency {
  Outcome outcome;    ///< singular: infinite derivative or only rigid modes; not_converged: modes
  Evidence evidence;  ///< residuals of the modes
  double frequency = 0;  ///< [Hz]; also defined if a limb is straight or folded
  /// Derivative of the frequency by the parameter [Hz / unit of the parameter]. For a repeated
  /// frequency, it is the lowest derivative in the direction of an increasing parameter.
  double derivative = 0;
  Counters counters;
};
/// Computes the first elastic frequency at a pose and its derivative by a parameter.
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

/// Map of the first elastic frequency over a grid of poses, row x column. Unreachable poses have
/// NaN. On the boundary of the workspace the derivative is infinite and therefore NaN.
struct SensitivityMap {
  PoseGrid grid;
  Eigen::MatrixXd frequency;        ///< f_1 [Hz]
  Eigen::MatrixXd derivative;       ///< d f_1 / dp [Hz / unit] for an increasing parameter
  Eigen::MatrixXd serial_distance;  ///< smallest |sin(elbow angle)| [-]
  Evidence evidence;                ///< residuals of the modes at all poses with a value
  Counters counters;
};

/// Computes the map of the first elastic frequency over the reachable workspace.
[[nodiscard]] SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                                 const DesignParameter& parameter,
                                                 const PoseGrid& grid);

using Polyline = std::vector<Vector2d>;  ///< (x, y) of P [m]

/// Returns the boundary of the workspace at the platform orientation phi [rad]. It consists of arcs
/// on which one limb is straight or folded (serial singularities) and the other limbs are within
/// reach. A full circle has `points` points.
[[nodiscard]] std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry,
                                                       double phi, Index points);

/// Returns the parallel singularities in the workspace, on which det J_x = 0. Each grid cell that
/// they cross has a straight segment, whose ends on two sides of the cell are exact. Only cell
/// sides within reach of all limbs are searched.
[[nodiscard]] std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                                           const PoseGrid& grid);

}  // namespace trammel::solver
