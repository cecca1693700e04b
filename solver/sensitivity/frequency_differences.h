#pragma once

#include "solver/sensitivity/frequency_sensitivity.h"

/// Sensitivities of the natural frequencies by differences of the changed design: a second route,
/// which shares no derivative with `frequency_sensitivity`.
namespace trammel::solver {

struct FrequencyDifferences {
  Outcome outcome;                 ///< as the modes of the design and of the changed ones
  Evidence evidence;               ///< of the modes of all designs
  Eigen::VectorXd frequency;       ///< ascending [Hz]
  Eigen::VectorXd derivative;      ///< [Hz / unit]; repeated frequencies as in FrequencySensitivity
  Eigen::VectorXd error_estimate;  ///< what the extrapolation itself says of its error [Hz / unit]
  double step = 0;                 ///< the largest [unit]
  Counters counters;
};

/// Central differences at steps that shrink by 1.6, extrapolated to zero; of the table, the entry
/// that agrees best with its neighbours (Ridders 1982; here in 7 rows). A step leaves neighbouring
/// frequencies apart and the limbs within reach. The branches of a repeated frequency are smooth:
/// the lowest for p + h goes on from the highest for p - h.
/// @param relative_step  the first step over the value of the parameter, where that leaves room
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencyDifferences differentiate_frequencies(const ManipulatorDesign& design,
                                                             const Pose& pose,
                                                             const DesignParameter& parameter,
                                                             Index count,
                                                             double relative_step = 5e-3);

/// One difference quotient, as it is: central over 2 h or forward over h.
/// @param relative_step  h over the value of the parameter, > 0; `error_estimate` stays infinite
/// @throws ModelError  as `build_manipulator`, so also where the step leads out of reach.
[[nodiscard]] FrequencyDifferences difference_quotient(const ManipulatorDesign& design,
                                                       const Pose& pose,
                                                       const DesignParameter& parameter,
                                                       Index count, double relative_step,
                                                       bool central);

}  // namespace trammel::solver
