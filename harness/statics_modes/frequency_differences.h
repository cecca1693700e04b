#pragma once

#include <Eigen/Core>

#include "solver/manipulator/frequency_sensitivity.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"

/// Sensitivities of the natural frequencies by differences, as a study over a parameter of the
/// design: a second route, which shares no derivative with `solver::frequency_sensitivity`. Values
/// of these parameters, and changed designs.
namespace trammel::harness {

struct DesignInPose {
  solver::ManipulatorDesign design;
  solver::Pose pose;
};

/// The design with the parameter increased by `change` [unit of the parameter: m, Pa, kg/m^3, -,
/// kg, kg m^2, N m/rad, rad].
[[nodiscard]] DesignInPose perturbed(const solver::ManipulatorDesign& design,
                                     const solver::Pose& pose,
                                     const solver::DesignParameter& parameter, double change);

/// The parameter's value [its unit]: the largest of the numbers that it names; 0 where the design
/// has none. Of the orientation 1 rad, for no angle counts as none.
[[nodiscard]] double parameter_value(const solver::ManipulatorDesign& design,
                                     const solver::DesignParameter& parameter);

struct FrequencyDifferences {
  solver::Outcome outcome;     ///< as the modes of the design and of the changed ones
  solver::Evidence evidence;   ///< of the modes of all designs
  Eigen::VectorXd frequency;   ///< ascending [Hz]
  Eigen::VectorXd derivative;  ///< [Hz / unit]; repeated ones as in FrequencySensitivity
  solver::Counters counters;
};

/// Central differences at steps that shrink by 1.6, extrapolated to zero; of the table, the entry
/// that agrees best with its neighbours (Ridders 1982; here in 7 rows). A step leaves neighbouring
/// frequencies apart and the limbs within reach. The branches of a repeated frequency are smooth:
/// the lowest for p + h goes on from the highest for p - h.
/// @param relative_step  the first step over the value of the parameter, where that leaves room
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencyDifferences differentiate_frequencies(
    const solver::ManipulatorDesign& design, const solver::Pose& pose,
    const solver::DesignParameter& parameter, solver::Index count, double relative_step = 5e-3);

/// One difference quotient, as it is: central over 2 h or forward over h.
/// @param relative_step  h over the value of the parameter, > 0
/// @throws ModelError  as `build_manipulator`, so also where the step leads out of reach.
[[nodiscard]] FrequencyDifferences difference_quotient(const solver::ManipulatorDesign& design,
                                                       const solver::Pose& pose,
                                                       const solver::DesignParameter& parameter,
                                                       solver::Index count, double relative_step,
                                                       bool central);

}  // namespace trammel::harness
