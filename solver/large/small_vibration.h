#pragma once

#include "solver/large/geometrically_exact_system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Modes q e^{s t} of small vibration about an equilibrium, s = g + 2 pi i f. g is the growth
/// rate [1/s], and f is the frequency [Hz].
struct SmallVibration {
  Outcome outcome;
  VectorXd frequency;    ///< f, ascending [Hz]; 0 for monotonic growth or decay
  VectorXd growth_rate;  ///< growth rate g of each mode, >= 0 [1/s]; 0 for pure vibration
  VectorXd roundoff;     ///< relative round-off error of each frequency due to stiff members
  Evidence evidence;
};

/// Largest number of coordinates for `small_vibration`. The matrix of `small_vibration` is dense,
/// and the computing time grows with the third power of the number of coordinates.
inline constexpr Index kMaxVibrationCoordinates = 400;

/// Computes the `count` modes with the lowest |s| of s^2 M x + K x + G^T y = 0, G x = C y. K is the
/// tangent stiffness of the state. The modes follow from the eigenvalues of K^-1 M for motions that
/// satisfy the constraints. Follower loads make K nonsymmetric. If two frequencies then coincide,
/// the structure flutters, which statics cannot show (V. V. Bolotin, Nonconservative Problems of
/// the Theory of Elastic Stability, 1963).
/// @throws ModelError  if there are more than kMaxVibrationCoordinates coordinates.
[[nodiscard]] SmallVibration small_vibration(const GeometricallyExactSystem& system,
                                             const State& state, Index count);

}  // namespace trammel::solver::large_motion
