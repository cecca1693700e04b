#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/modes/modes.h"
#include "solver/sensitivity/design_parameter.h"
#include "solver/sensitivity/frequency_sets.h"

/// How the natural frequencies of the manipulator change with its design (paper Eq. 30-35):
///   d f / dp = (1 / 8 pi^2 f) x^T (dK/dp - (2 pi f)^2 dM/dp) x,   x^T M x = 1,
/// with the pose held, so that the joint angles move with the link lengths. dK/dp and dM/dp are
/// exact: dual numbers (dual.h) through the functions that the builder and the elements are made
/// of; where a parameter reaches further than into sections and links (`is_seeded`), by
/// extrapolated differences (frequency_differences.h) instead. Whether a link's mass is held as a
/// total or follows from its density is the design's choice.
namespace trammel::solver {

struct FrequencySensitivity {
  /// singular: a limb is straight or folded and the derivative infinite; not_converged: as the
  /// modes.
  Outcome outcome;
  Evidence evidence;          ///< of the modes
  Eigen::VectorXd frequency;  ///< ascending [Hz]
  /// mode x parameter [Hz / unit of the parameter]. Within a set of repeated frequencies: the
  /// directional derivatives, eigenvalues of X^T (dK/dp - w^2 dM/dp) X over the set, ascending, as
  /// the frequencies order themselves when p grows. 0 for rigid motions.
  Eigen::MatrixXd derivative;
  std::vector<FrequencySet> sets;
  /// Distance of each mode's frequency from the nearest one outside its set, over its own: the
  /// derivative loses about as many digits as this is small.
  Eigen::VectorXd gap;
  Counters counters;
};

/// @param count  modes; of a set that goes on beyond, the lowest derivatives are returned
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencySensitivity frequency_sensitivity(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

}  // namespace trammel::solver
