#pragma once

#include <cmath>

/// Quantity of a motion with its first and second time derivative. Each operation applies the rules
/// of differentiation, so that formulas of positions also yield velocities and accelerations.
namespace trammel::references {

/// @tparam T  scalar type: Real, or another type with + - * / sqrt, sin and cos.
template <class T>
struct Jet {
  T value = 0, rate = 0, acceleration = 0;

  Jet() = default;
  Jet(const T& constant) : value(constant) {}  // NOLINT(google-explicit-constructor)
  Jet(int constant) : value(constant) {}       // NOLINT(google-explicit-constructor)
  Jet(const T& v, const T& r, const T& a) : value(v), rate(r), acceleration(a) {}

  [[nodiscard]] friend Jet operator-(const Jet& a) { return {-a.value, -a.rate, -a.acceleration}; }
  [[nodiscard]] friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
  }
  [[nodiscard]] friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  [[nodiscard]] friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate,
            a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
  }
  [[nodiscard]] friend Jet operator/(const Jet& a, const Jet& b) {
    const T i = 1 / b.value;
    return a * chain_rule(b, i, -i * i, 2 * i * i * i);
  }
  [[nodiscard]] friend Jet sqrt(const Jet& a) {
    using std::sqrt;
    const T root = sqrt(a.value);
    return chain_rule(a, root, 1 / (2 * root), -1 / (4 * root * a.value));
  }
  [[nodiscard]] friend Jet sin(const Jet& a) {
    using std::cos, std::sin;
    const T s = sin(a.value);
    return chain_rule(a, s, cos(a.value), -s);
  }
  [[nodiscard]] friend Jet cos(const Jet& a) {
    using std::cos, std::sin;
    const T c = cos(a.value);
    return chain_rule(a, c, -sin(a.value), -c);
  }
  [[nodiscard]] friend bool operator<(const Jet& a, const T& b) { return a.value < b; }

 private:
  /// Returns f(a) with its time derivatives, from f, f' and f'' at the value of a.
  [[nodiscard]] static Jet chain_rule(const Jet& a, const T& f, const T& df, const T& ddf) {
    return {f, df * a.rate, ddf * a.rate * a.rate + df * a.acceleration};
  }
};

}  // namespace trammel::references
