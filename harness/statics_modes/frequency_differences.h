#pragma once

#include <Eigen/Core>

#include "solver/manipulator/frequency_sensitivity.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"

/// Computes sensitivities of the natural frequencies by finite differences over a design parameter.
/// The method is independent of the exact derivatives of `solver::frequency_sensitivity`. Further
/// functions return and change the values of design parameters.
namespace trammel::harness {

struct DesignInPose {
  solver::ManipulatorDesign design;
  solver::Pose pose;
};

/// Returns the design with the parameter increased by `change` [unit of the parameter: m, Pa,
/// kg/m^3, -, kg, kg m^2, N m/rad, rad].
[[nodiscard]] DesignInPose perturb_design(const solver::ManipulatorDesign& design,
                                          const solver::Pose& pose,
                                          const solver::DesignParameter& parameter, double change);

/// Returns the value of a parameter: the largest value of the selected parts, or 0 if no part has
/// this parameter. For the orientation, returns 1 rad, because an angle has no natural zero.
[[nodiscard]] double parameter_value(const solver::ManipulatorDesign& design,
                                     const solver::DesignParameter& parameter);

struct FrequencyDifferences {
  /// Outcome of computing the modes of the designs with the original and with changed parameter
  /// values.
  solver::Outcome outcome;
  solver::Evidence evidence;   ///< residuals of the modes of all designs
  Eigen::VectorXd frequency;   ///< natural frequencies of the original design, ascending [Hz]
  Eigen::VectorXd derivative;  ///< [Hz / unit], ordered as in FrequencySensitivity
  solver::Counters counters;
};

/// Computes the derivatives by central differences with up to 7 finite-difference steps, each
/// smaller than the previous one by the factor 1.6. Extrapolates the differences to the step zero.
/// From the table of extrapolated values, it selects the entry that agrees best with its neighbors
/// (Ridders 1982). The steps are so small that adjacent frequencies remain apart and the pose
/// remains within reach. The branches of a repeated frequency are smooth. Therefore, at a parameter
/// p with step h, the lowest branch for p + h continues the highest branch for p - h.
/// @param relative_step  ratio of the first step to the value of the parameter; reduced if it is
///   too large
/// @throws ModelError  if the design is invalid (see `build_manipulator`).
[[nodiscard]] FrequencyDifferences differentiate_frequencies(
    const solver::ManipulatorDesign& design, const solver::Pose& pose,
    const solver::DesignParameter& parameter, solver::Index count, double relative_step = 5e-3);

/// Computes one difference quotient without extrapolation: central over 2 h or forward over h.
/// @param relative_step  ratio of the step h to the value of the parameter, > 0
/// @throws ModelError  if the design is invalid (see `build_manipulator`), or if the design with
///   the changed parameter cannot reach the pose.
[[nodiscard]] FrequencyDifferences difference_quotient(const solver::ManipulatorDesign& design,
                                                       const solver::Pose& pose,
                                                       const solver::DesignParameter& parameter,
                                                       solver::Index count, double relative_step,
                                                       bool central);

}  // namespace trammel::harness
