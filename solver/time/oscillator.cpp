#include "solver/time/oscillator.h"

#include <cmath>

namespace trammel::solver {
namespace {

/// w t < 1 and c t < 1: Taylor, since the closed forms subtract nearly equal numbers.
ImpulseResponse by_series(double omega, double decay, double t) {
  const double c = decay * t;
  const double w2 = omega * t * omega * t;
  // h = t sum b_k, b_0 the coefficient of t^1
  double before = 0;
  double b = 1;
  ImpulseResponse r{.dh = 0, .h = 0, .h1 = 0, .h2 = 0};
  for (int k = 1; k <= 30; ++k) {
    r.dh += k * b;
    r.h += b;
    r.h1 += b / (k + 1);
    r.h2 += b / ((k + 1) * (k + 2));
    const double next = -(2 * c * k * b + w2 * before) / (k * (k + 1));
    before = b;
    b = next;
  }
  r.h *= t;
  r.h1 *= t * t;
  r.h2 *= t * t * t;
  return r;
}

/// int_0^t exp(-rate s) ds and its integral.
struct Decay {
  double once, twice;
};

Decay integrate_decay(double rate, double t) {
  const double x = rate * t;
  if (x < 0.5) {
    double term = 1;  // (-x)^k / k!
    Decay sum{0, 0};
    for (int k = 0; k < 20; ++k) {
      sum.once += term / (k + 1);
      sum.twice += term / ((k + 1) * (k + 2));
      term *= -x / (k + 1);
    }
    return {sum.once * t, sum.twice * t * t};
  }
  const double once = -std::expm1(-x) / rate;
  return {once, (t - once) / rate};
}

/// Roots far apart: the two decays apart from each other.
ImpulseResponse by_decays(double omega, double decay, double root, double t) {
  const double fast = decay + root;
  const double slow = omega * omega / fast;
  const double gap = 2 * root;
  const double e_slow = std::exp(-slow * t);
  const double e_fast = std::exp(-fast * t);
  const Decay s = integrate_decay(slow, t);
  const Decay f = integrate_decay(fast, t);
  return {.dh = (fast * e_fast - slow * e_slow) / gap,
          .h = (e_slow - e_fast) / gap,
          .h1 = (s.once - f.once) / gap,
          .h2 = (s.twice - f.twice) / gap};
}

}  // namespace

ImpulseResponse impulse_response(double omega, double decay, double t) {
  if (omega * t < 1 && decay * t < 1) return by_series(omega, decay, t);
  const double D = (decay - omega) * (decay + omega);
  const double root = std::sqrt(std::abs(D));
  if (D > decay * decay / 4) return by_decays(omega, decay, root, t);
  const double x = root * t;
  const double envelope = std::exp(-decay * t);
  double even = 0;  // envelope * cosh(sqrt(D) t)
  double odd = 0;   // envelope * sinh(sqrt(D) t) / sqrt(D)
  if (x < 1) {
    double term = 1;
    for (int k = 0; k < 12; ++k) {
      even += term;
      odd += term / (2 * k + 1);
      term *= (D > 0 ? x * x : -x * x) / ((2 * k + 1) * (2 * k + 2));
    }
    even *= envelope;
    odd *= envelope * t;
  } else if (D < 0) {
    even = envelope * std::cos(x);
    odd = envelope * std::sin(x) / root;
  } else {
    const double slow = std::exp(-omega * omega / (decay + root) * t);
    const double fast = std::exp(-(decay + root) * t);
    even = (slow + fast) / 2;
    odd = (slow - fast) / (2 * root);
  }
  ImpulseResponse r;
  r.h = odd;
  r.dh = even - decay * odd;
  r.h1 = (1 - (even + decay * odd)) / (omega * omega);
  r.h2 = (t - 2 * decay * r.h1 - r.h) / (omega * omega);
  return r;
}

OscillatorState advance(const ImpulseResponse& r, double omega, const OscillatorState& start,
                        double p0, double p1) {
  const double k = omega * omega;
  return {.y = start.y * (1 - k * r.h1) + start.v * r.h + p0 * r.h1 + p1 * r.h2,
          .v = -start.y * k * r.h + start.v * r.dh + p0 * r.h + p1 * r.h1};
}

}  // namespace trammel::solver
