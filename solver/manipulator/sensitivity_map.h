#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/frequency_sensitivity.h"

/// First elastic frequency and its derivative by a design parameter over the workspace (Varalakshmi
/// & Srinivas 2017, Fig. 16), and singularity curves. All results are for a fixed orientation of
/// the platform.
namespace trammel::solver {

/// First elastic frequency at one pose. Frequency and derivative are NaN if they were not computed.
struct FirstFrequency {
  /// singular: infinite derivative, or only rigid modes; not_converged: the modes did not converge.
  Outcome outcome;
  Evidence evidence;  ///< residuals of the modes
  /// First elastic frequency [Hz]; also defined if a limb is straight or folded.
  double frequency = 0;
  /// Derivative of the frequency by the parameter [Hz / unit of the parameter]. For a repeated
  /// frequency, this is the lowest directional derivative for an increasing parameter.
  double derivative = 0;
  Counters counters;
};
/// Computes the first elastic frequency at a pose and its derivative by a parameter.
[[nodiscard]] FirstFrequency first_frequency(const ManipulatorDesign& design,
                                             const DesignParameter& parameter, const Pose& pose);

/// Grid of poses x = x0 + i dx, y = y0 + j dy at the fixed orientation phi.
struct PoseGrid {
  double x0 = 0, y0 = 0;  ///< position of the first grid point [m]
  double dx = 0, dy = 0;  ///< spacings of the grid along x and y, > 0 [m]
  Index columns = 0, rows = 0;
  double phi = 0;  ///< orientation of the platform [rad]

  [[nodiscard]] Pose pose(Index row, Index column) const {
    return {x0 + static_cast<double>(column) * dx, y0 + static_cast<double>(row) * dy, phi};
  }
};

/// Returns the smallest grid of square cells that contains all poses within reach of all three
/// limbs.
[[nodiscard]] PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi,
                                      Index columns);

/// Map of the first elastic frequency over a grid of poses, row x column. Values at unreachable
/// poses are NaN. On the boundary of the workspace, the derivative is infinite and is stored as
/// NaN.
struct SensitivityMap {
  PoseGrid grid;
  Eigen::MatrixXd frequency;        ///< first elastic frequency f_1 [Hz]
  Eigen::MatrixXd derivative;       ///< d f_1 / dp [Hz / unit] for an increasing parameter
  Eigen::MatrixXd serial_distance;  ///< smallest |sin(elbow angle)| of the three limbs [-]
  /// Largest residuals of the modes at all poses with a solution.
  Evidence evidence;
  Counters counters;
};

/// Computes the map of the first elastic frequency over the reachable workspace.
[[nodiscard]] SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                                 const DesignParameter& parameter,
                                                 const PoseGrid& grid);

using Polyline = std::vector<Vector2d>;  ///< positions (x, y) of the platform point P [m]

/// Returns the boundary of the workspace at the platform orientation phi [rad]. The boundary
/// consists of arcs on which one limb is straight or folded (serial singularities) and the other
/// two limbs reach the pose. A full circle is divided into `points` intervals.
[[nodiscard]] std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry,
                                                       double phi, Index points);

/// Returns the parallel singularities in the workspace, on which the Jacobian matrix J_x has the
/// determinant 0. The curve in each grid cell is approximated by a straight segment, whose two ends
/// on the cell sides are exact. Only cell sides within reach of all limbs are searched.
[[nodiscard]] std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                                           const PoseGrid& grid);

}  // namespace trammel::solver
