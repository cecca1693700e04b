#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/manipulator.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct PoseModesOptions {
  Index count = 6;                  ///< modes at each pose
  Effects active = Effects::all();  ///< effects that are not among them are taken out
  Index threads = 0;                ///< 0: one a core; any number has the same result, to the bit
};

/// Natural frequencies of one manipulator at many poses (paper Eq. 28, 29), a column a pose; NaN
/// where there is no solution, and below the last where there are fewer modes.
struct PoseModes {
  std::vector<Outcome> outcome;  ///< singular: out of reach, or as ModalSolution
  Eigen::MatrixXd frequency;     ///< ascending, rigid motions as 0 [Hz]
  Eigen::MatrixXd roundoff;      ///< relative, as in ModalSolution [-]
  std::vector<Evidence> evidence;
  std::vector<Index> zero_energy_mode_count;
  Index free_coordinates = 0;
  double coupling = 0;  ///< largest product of modes inside a link that were taken for orthogonal
  Index by_itself = 0;  ///< poses that `solve_modes` has solved
  Counters counters;
};

/// Subspace iteration on the links' condensed matrices (moving_pencil.h), each pose beginning with
/// the modes of the one before, within blocks of 64 poses whatever the number of threads. That none
/// is missed is certified pose by pose: as many eigenvalues lie below a shift in the gap behind the
/// last as were found. A pose that cannot be certified so, as at a parallel singularity or with
/// actuators that move freely, is solved by itself, by `solve_modes`.
/// Source: Bathe (2014), ch. 11.6, for the iteration.
/// @throws ModelError  as `build_manipulator`, but not for a pose that is out of reach.
[[nodiscard]] PoseModes solve_pose_modes(const ManipulatorDesign& design,
                                         const std::vector<Pose>& poses,
                                         const PoseModesOptions& options);

}  // namespace trammel::solver
