#pragma once

#include "solver/large/geometrically_exact_system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Small vibration q e^{s t}, s = g + 2 pi i f, about an equilibrium.
struct SmallVibration {
  Outcome outcome;
  VectorXd frequency;    ///< f, ascending [Hz]; 0 for what grows or decays without turning over
  VectorXd growth_rate;  ///< g of the growing one of each pair [1/s]; 0 where it only swings
  VectorXd roundoff;     ///< relative round-off error that stiff parts leave of each frequency
  Evidence evidence;
};

/// Largest number of coordinates: the matrix is dense, its cost grows with their third power.
inline constexpr Index kMaxVibrationCoordinates = 400;

/// The lowest |s| of s^2 M x + K x + G^T y = 0, G x = C y with the tangent K of the state, which
/// follower loads make nonsymmetric: where two frequencies meet, the motion flutters, and no
/// statics shows it (V. V. Bolotin, Nonconservative Problems of the Theory of Elastic Stability,
/// 1963). Eigenvalues of K^-1 M on the constraints, the largest first.
/// @throws ModelError  above kMaxVibrationCoordinates.
[[nodiscard]] SmallVibration small_vibration(const GeometricallyExactSystem& system,
                                             const State& state, Index count);

}  // namespace trammel::solver::large_motion
