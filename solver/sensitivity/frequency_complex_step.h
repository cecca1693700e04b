#pragma once

#include "solver/sensitivity/frequency_sensitivity.h"

/// Sensitivities of the natural frequencies by complex steps of the design: a route that goes
/// through the eigenvalue problem itself, where Eq. 35 goes through its energies.
namespace trammel::solver {

struct FrequencyComplexStep {
  Outcome outcome;             ///< singular: as FrequencySensitivity, or repeated frequencies
  Evidence evidence;           ///< of the modes
  Eigen::VectorXd frequency;   ///< ascending [Hz]
  Eigen::MatrixXd derivative;  ///< mode x parameter [Hz / unit]; 0 for rigid motions
  Counters counters;
};

/// K and M of the design at p + ih (dual.h), and of each mode the root of
///   (K - lambda M) x = 0,  x_0^T M (x - x_0) = 0
/// near the real one by Newton's method in complex arithmetic: d lambda / dp = Im lambda / h. One
/// factorization a mode and parameter; transposed, never conjugated, so that all stays analytic.
/// @throws ModelError  as `build_manipulator`, and for inextensible links, whose constraints move.
[[nodiscard]] FrequencyComplexStep differentiate_by_complex_step(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

}  // namespace trammel::solver
