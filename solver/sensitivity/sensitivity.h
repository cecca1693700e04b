#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/manipulator/manipulator.h"
#include "solver/modes/modes.h"

/// How the natural frequencies of the manipulator change with its design (paper Eq. 30-35):
///   d f / dp = (1 / 8 pi^2 f) x^T (dK/dp - (2 pi f)^2 dM/dp) x,   x^T M x = 1,
/// with the pose held, so that the joint angles move with the link lengths. dK/dp and dM/dp are
/// exact: dual numbers (dual.h) through the functions that the builder and the elements are made
/// of. Whether a link's mass is held as a total or follows from its density is the design's choice.
namespace trammel::solver {

/// A number of the design, or several that change together by the same amount.
struct DesignParameter {
  enum class Quantity { length, thickness, width, E, density };
  Quantity quantity = Quantity::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  bool platform = false;  ///< its thickness, E or density too
};

/// [m], [m], [m], [Pa], [kg/m^3].
[[nodiscard]] const char* unit(DesignParameter::Quantity quantity);

/// The design with the parameter increased by `change` [unit of the parameter].
[[nodiscard]] ManipulatorDesign perturbed(const ManipulatorDesign& design,
                                          const DesignParameter& parameter, double change);

/// The parameter's value [its unit]: the largest of the numbers that it names.
[[nodiscard]] double parameter_value(const ManipulatorDesign& design,
                                     const DesignParameter& parameter);

/// Modes whose frequencies are equal but for round-off. Their shapes are an arbitrary basis of
/// their subspace; what has a meaning are the derivatives of the set.
struct FrequencySet {
  Index first = 0;
  Index count = 1;
};

/// @param frequency  ascending [Hz]
[[nodiscard]] std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency);

struct FrequencySensitivity {
  /// singular: a limb is straight or folded and the derivative infinite; not_converged: as the
  /// modes.
  Outcome outcome;
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

/// @param count  modes; of a set that goes on beyond, the lowest derivatives are kept
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencySensitivity frequency_sensitivity(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

/// The first elastic frequency at one pose; NaN unless solved.
struct FirstFrequency {
  Outcome outcome;       ///< as FrequencySensitivity; singular too where all motions are rigid
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
};

/// The grid that just holds all poses within reach of the three limbs, square cells.
[[nodiscard]] PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi,
                                      Index columns);

/// row x column; NaN where there is no value. At a pose on the boundary of the reach, where the
/// derivative is infinite, only the frequency and the distances have values.
struct SensitivityMap {
  PoseGrid grid;
  Eigen::MatrixXd frequency;   ///< f_1 [Hz]
  Eigen::MatrixXd derivative;  ///< d f_1 / dp [Hz / unit], as the parameter grows
  Eigen::MatrixXd parallel_distance, serial_distance;  ///< as in Jacobians [-]
  Eigen::ArrayXX<bool> reachable;
  Counters counters;
};

/// Map of the first elastic frequency over the reachable workspace (paper Fig. 16).
[[nodiscard]] SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                                 const DesignParameter& parameter,
                                                 const PoseGrid& grid);

}  // namespace trammel::solver
