#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/manipulator.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Options for natural frequencies at many poses.
struct PoseModesOptions {
  Index count = 6;                  ///< number of modes at each pose
  Effects active = Effects::all();  ///< active effects; all others are removed from the model
  /// Number of threads; 0: one thread per core. Results are bit-identical for any number of
  /// threads.
  Index threads = 0;
};

/// Natural frequencies of a manipulator at many poses (Varalakshmi & Srinivas 2017, Eq. 28, 29),
/// one column per pose. A column is NaN if the pose has no solution. If the model has fewer modes
/// than requested, the end of the column is NaN.
struct PoseModes {
  /// singular: the pose is out of reach, or a status of ModalSolution.
  std::vector<Outcome> outcome;
  /// Natural frequencies, ascending, 0 for rigid modes [Hz].
  Eigen::MatrixXd frequency;
  Eigen::MatrixXd roundoff;  ///< relative round-off error of each frequency [-]
  std::vector<Evidence> evidence;
  std::vector<Index> zero_energy_mode_count;
  Index free_coordinates = 0;
  double coupling = 0;  ///< largest neglected coupling of modes within a link (LinkSuperelement)
  /// Number of poses whose modes are computed by `solve_modes` instead of subspace iteration.
  Index by_itself = 0;
  Counters counters;
};

/// Computes the natural frequencies at many poses by subspace iteration on condensed matrices
/// (moving_pencil.h). The iteration starts with the modes of the preceding pose in the same block
/// of 64 poses. Results are therefore the same for any number of threads. Sylvester's law of
/// inertia certifies that no mode is missing: the number of eigenvalues below a shift above the
/// last mode must equal the number of modes. Poses without this certificate are solved separately
/// by `solve_modes`. Examples are parallel singularities and poses of a manipulator with free
/// actuators. Source: Bathe (2014), ch. 11.6, for the iteration.
/// @param design  manipulator.
/// @param poses  poses of the platform.
/// @param options  number of modes, active effects, number of threads.
/// @throws ModelError  as `build_manipulator`, except for a pose that is out of reach.
[[nodiscard]] PoseModes solve_pose_modes(const ManipulatorDesign& design,
                                         const std::vector<Pose>& poses,
                                         const PoseModesOptions& options);

}  // namespace trammel::solver
