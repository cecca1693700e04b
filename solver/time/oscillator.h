#pragma once

namespace trammel::solver {

/// Impulse response of y'' + 2 c y' + w^2 y = p and its integrals over a time t:
///   h'' + 2 c h' + w^2 h = 0, h(0) = 0, h'(0) = 1,  h1 = int h,  h2 = int h1.
/// A load p0 + p1 t moves the oscillator exactly by
///   y(t)  = y0 (1 - w^2 h1) + v0 h  + p0 h1 + p1 h2,
///   y'(t) = -y0 w^2 h       + v0 h' + p0 h  + p1 h1.
/// Any c >= 0 and w >= 0: rigid motion, under-, critical and overdamping, each by a formula that
/// keeps its digits.
struct ImpulseResponse {
  double dh = 1;  ///< h' [-]
  double h = 0;   ///< [s]
  double h1 = 0;  ///< [s^2]
  double h2 = 0;  ///< [s^3]
};

/// @param omega  w >= 0 [rad/s];  @param decay  c = ratio * w >= 0 [1/s];  @param t  >= 0 [s]
[[nodiscard]] ImpulseResponse impulse_response(double omega, double decay, double t);

struct OscillatorState {
  double y = 0;  ///< [SI]
  double v = 0;  ///< y' [SI/s]
};

/// The state a time t later, under the load p0 at its beginning and p1 per second after.
[[nodiscard]] OscillatorState advance(const ImpulseResponse& response, double omega,
                                      const OscillatorState& start, double p0, double p1);

}  // namespace trammel::solver
