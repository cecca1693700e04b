#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

#include "references/beams/programs.h"

/// Run-up of a rotor through the resonance of its carriage (F. M. Lewis, Vibration during
/// acceleration through a critical speed, Transactions of the ASME 54, 1932, 253-261): an unbalance
/// m e of the total mass M on a spring, w^2 = k/M, turned by a given law a(t) from rest, a(0) = 0:
///   x = -(m e/M) (cos a(t) - cos w t - w int_0^t cos a(s) sin w(t - s) ds),
/// Duhamel's integral twice by parts; here by Gauss' rule of 20 points on panels of 0.01 s.
namespace trammel::references {

std::vector<Real> run_up_program(const Arguments& arguments) {
  const Real w = arguments.positive("angular_frequency_rad_s"),
             T = arguments.positive("duration_s");
  const Real speed = arguments.positive("speed_rad_s"), turn = 2 * pi<Real>();
  const auto angle = [&](const Real& t) {
    return Real(speed * (t * t / (2 * T) + T / (turn * turn) * (cos(turn * t / T) - 1)));
  };
  const auto in_phase = [&](const Real& s) { return Real(cos(angle(s)) * cos(w * s)); };
  const auto out_of_phase = [&](const Real& s) { return Real(cos(angle(s)) * sin(w * s)); };
  using Gauss = boost::math::quadrature::gauss<Real, 20>;
  std::vector<Real> values;
  Real from = 0, cosine = 0, sine = 0;
  for (const Real& t : arguments.numbers("times_s")) {
    if (t < from || t > T) arguments.fail("times_s", "ascending times within the duration");
    while (from < t) {
      const Real to = std::min(t, Real(from + Real(1) / 100));
      cosine += Gauss::integrate(in_phase, from, to);
      sine += Gauss::integrate(out_of_phase, from, to);
      from = to;
    }
    const Real integral = sin(w * t) * cosine - cos(w * t) * sine;
    values.push_back(static_cast<double>(-arguments.positive("unbalance_m") *
                                         (cos(angle(t)) - cos(w * t) - w * integral)));
  }
  return values;
}

}  // namespace trammel::references
