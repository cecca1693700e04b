#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// The estimator of Nadaraya and Watson (1964), which Specht (1991) calls a general regression
/// neural network, by its printed formula in extended precision:
///   Y(x) = sum_i Y_i exp(-D_i^2 / 2 s^2) / sum_i exp(-D_i^2 / 2 s^2),
/// numerator and denominator multiplied by exp(min D^2 / 2 s^2), which changes nothing but that
/// neither underflows.
namespace trammel::references {

/// @param inputs, outputs  one row a sample
[[nodiscard]] std::vector<Real> nadaraya_watson(const std::vector<std::vector<Real>>& inputs,
                                                const std::vector<std::vector<Real>>& outputs,
                                                const std::vector<Real>& query, const Real& sigma);

/// Arguments: inputs, outputs, queries (arrays of rows); sigma, or spread in the convention of
/// MATLAB's newgrnn, exp(-(0.8326 D / spread)^2). Values: the outputs at each query.
[[nodiscard]] std::vector<double> grnn_program(const Json& arguments);

/// Arguments: manipulator, trajectory, force_N, moment_N_m, gravity_m_s2 as for torques; step_s,
/// train (points, from the first), sigma [N m], queries (numbers of points), output (angles |
/// velocities). Torques by Newton and Euler train angles and velocities of the active joints.
/// Values: what is predicted for A1 at each query, for A2, for A3 [rad or rad/s].
[[nodiscard]] std::vector<double> manipulator_grnn_program(const Json& arguments);

}  // namespace trammel::references
