#pragma once

#include "references/numerics/real.h"

/// A quantity along a motion with its first and second derivative by time, carried through every
/// operation by the rules of differentiation: positions in, velocities and accelerations out.
namespace trammel::references {

struct Jet {
  Real value = 0, rate = 0, acceleration = 0;

  Jet() = default;
  Jet(const Real& constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a number
  Jet(int constant) : value(constant) {}          // NOLINT(google-explicit-constructor): a number
  Jet(const Real& v, const Real& r, const Real& a) : value(v), rate(r), acceleration(a) {}
};

[[nodiscard]] inline Jet operator-(const Jet& a) {
  return {-a.value, -a.rate, -a.acceleration};
}
[[nodiscard]] inline Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
}
[[nodiscard]] inline Jet operator-(const Jet& a, const Jet& b) {
  return a + -b;
}
[[nodiscard]] inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}

/// f(a), from f, f' and f'' at its value.
[[nodiscard]] inline Jet chain_rule(const Jet& a, const Real& f, const Real& df, const Real& ddf) {
  return {f, df * a.rate, ddf * a.rate * a.rate + df * a.acceleration};
}
[[nodiscard]] inline Jet operator/(const Jet& a, const Jet& b) {
  const Real i = 1 / b.value;
  return a * chain_rule(b, i, -i * i, 2 * i * i * i);
}
[[nodiscard]] inline Jet sqrt(const Jet& a) {
  const Real root = sqrt(a.value);
  return chain_rule(a, root, 1 / (2 * root), -1 / (4 * root * a.value));
}
[[nodiscard]] inline Jet sin(const Jet& a) {
  const Real s = sin(a.value);
  return chain_rule(a, s, cos(a.value), -s);
}
[[nodiscard]] inline Jet cos(const Jet& a) {
  const Real c = cos(a.value);
  return chain_rule(a, c, -sin(a.value), -c);
}
[[nodiscard]] inline bool operator<(const Jet& a, const Real& b) {
  return a.value < b;
}

}  // namespace trammel::references
