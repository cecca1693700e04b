#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Run-up of a rotor through the resonance of its carriage (F. M. Lewis, Vibration during
/// acceleration through a critical speed, Transactions of the ASME 54, 1932, 253-261): an unbalance
/// m e of the whole mass M on a spring, w^2 = k/M, turned by a given law a(t) from rest, a(0) = 0:
///   x = -(m e/M) (cos a(t) - cos w t - w int_0^t cos a(s) sin w(t - s) ds),
/// Duhamel's integral twice by parts; here by Gauss' rule of 20 points on panels of 0.01 s.
namespace trammel::references {

/// Arguments: unbalance_m (m e/M), angular_frequency_rad_s (w), speed_rad_s (W) and duration_s (T)
/// of a' = W (t/T - sin(2 pi t/T)/(2 pi)), times_s, ascending, at most T. Values: x [m] at each.
[[nodiscard]] std::vector<double> run_up_program(const Json& arguments);

}  // namespace trammel::references
