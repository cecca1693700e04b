#pragma once

#include <array>
#include <functional>

#include "solver/linear/system.h"
#include "solver/model/evidence.h"
#include "solver/motion/transient.h"

/// Small motion relative to axes that rotate with a prescribed speed Omega(t).
namespace trammel::solver {

/// Prescribed rotation of the axes in which small motions are described.
struct PrescribedRotation {
  /// Function that returns the angular speed Omega of the axes [rad/s] and its time derivative
  /// [rad/s^2], counterclockwise.
  std::function<std::array<double, 2>(double time)> speed;
  Vector2d center = Vector2d::Zero();  ///< center of rotation [m]
  /// true: include K_1, the geometric stiffness of the centrifugal forces at 1 rad/s on the
  /// undeformed structure, from linear statics. Without K_1, the structure loses stiffness with
  /// increasing speed (Kane, Ryan and Banerjee 1987).
  bool stiffening = true;
};

/// Converts M q.. + C q. + K q = 0 to the equation of motion relative to rotating axes. The
/// supports are fixed to these axes:
///
///   \f[ M \ddot q + (C + 2 \Omega G) \dot q + (K + \Omega^2 (K_1 - S) + \dot \Omega G) q
///       = \Omega^2 f_c + \dot \Omega f_e. \f]
///
/// G, S and f_c are defined in rotating_frame.h. f_e is -M times the acceleration field of a unit
/// angular acceleration.
/// @returns singular if the model has no static equilibrium under the centrifugal forces.
/// @throws ModelError  if the model has loads or gravity, which would not rotate with the axes.
[[nodiscard]] Outcome add_rotating_frame_terms(const System& system,
                                               const PrescribedRotation& rotation,
                                               EquationOfMotion& equation);

}  // namespace trammel::solver
