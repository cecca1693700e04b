#pragma once

#include <array>
#include <functional>

#include "solver/linear/system.h"
#include "solver/model/evidence.h"
#include "solver/motion/transient.h"

/// Small motion as seen from axes that turn at a given speed W(t), which need not be steady.
namespace trammel::solver {

struct PrescribedRotation {
  /// W [rad/s] and W. [rad/s^2], counterclockwise.
  std::function<std::array<double, 2>(double time)> speed;
  Vector2d centre = Vector2d::Zero();  ///< about which they turn [m]
  /// K_1: the geometric stiffness of the centrifugal forces at 1 rad/s on the undeformed frame, by
  /// linear statics. Without it the frame loses its stiffness as it turns faster (Kane, Ryan and
  /// Banerjee 1987).
  bool stiffening = true;
};

/// Makes of M q.. + C q. + K q = 0 the equation of the motion relative to the axes, which hold the
/// supports:
///   M q.. + (C + 2 W G) q. + (K + W^2 (K_1 - S) + W. G) q = W^2 f_c + W. f_e
/// (rotating_frame.h for G, S and f_c), f_e = -M times a unit angular acceleration of the whole.
/// @returns singular where the centrifugal forces have no statics.
/// @throws ModelError  for a model with loads or gravity: they would not turn with the axes.
[[nodiscard]] Outcome add_rotating_frame_terms(const System& system,
                                               const PrescribedRotation& rotation,
                                               EquationOfMotion& equation);

}  // namespace trammel::solver
