#pragma once

#include <arb.h>

#include <string>

#include "references/numerics/real.h"

/// Ball arithmetic. A ball consists of a number and a radius. The radius bounds the distance to the
/// true number, because it includes all round-off errors. Source: F. Johansson, IEEE Trans.
/// Computers 66(8), 2017, 1281-1292 (Arb).
namespace trammel::references {

class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(int value) : Ball() { arb_set_si(x_, value); }  // NOLINT(google-explicit-constructor)
  /// Creates a ball around a number of 50 digits. The radius is 1e-45 times the magnitude of the
  /// number, or 0 for an integer with a magnitude below 1e6.
  explicit Ball(const Real& value);
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  /// Returns the center of the ball as an exact number.
  [[nodiscard]] Ball middle() const;
  /// Returns the number that the ball encloses as text with 30 digits, such as
  /// "1.87510406871196116644530824107".
  /// @throws DerivationError  if the radius is too large to determine 30 digits.
  [[nodiscard]] std::string digits() const;
  /// Returns the only integer in the ball.
  /// @throws DerivationError  if the ball contains no or several integers.
  explicit operator int() const;

  friend Ball operator+(const Ball& a, const Ball& b) { return apply(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return apply(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return apply(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return apply(arb_div, a, b); }
  Ball operator-() const { return 0 - *this; }
  Ball& operator+=(const Ball& b) { return *this = *this + b; }
  Ball& operator-=(const Ball& b) { return *this = *this - b; }

  // Comparisons return true or false if they are true or false for all numbers of both balls.
  /// @throws DerivationError  if the balls overlap.
  friend bool operator<(const Ball& a, const Ball& b) { return decide(a, b, arb_lt, arb_ge); }
  friend bool operator>(const Ball& a, const Ball& b) { return decide(a, b, arb_gt, arb_le); }
  friend bool operator>=(const Ball& a, const Ball& b) { return decide(a, b, arb_ge, arb_lt); }
  /// Returns true if both balls are the same exact number.
  friend bool operator==(const Ball& a, const Ball& b) {
    return arb_is_exact(a.x_) != 0 && arb_equal(a.x_, b.x_) != 0;
  }

  friend Ball sqrt(const Ball& a) { return apply(arb_sqrt, a); }
  friend Ball sin(const Ball& a) { return apply(arb_sin, a); }
  friend Ball cos(const Ball& a) { return apply(arb_cos, a); }
  friend Ball acos(const Ball& a) { return apply(arb_acos, a); }
  friend Ball tanh(const Ball& a) { return apply(arb_tanh, a); }
  friend Ball log(const Ball& a) { return apply(arb_log, a); }
  friend Ball ceil(const Ball& a) { return apply(arb_ceil, a); }
  friend Ball abs(const Ball& a) {
    Ball result;
    arb_abs(result.x_, a.x_);
    return result;
  }

 private:
  static constexpr slong kBits = 512;
  using Binary = void (*)(arb_t, const arb_t, const arb_t, slong);
  using Unary = void (*)(arb_t, const arb_t, slong);
  using Relation = int (*)(const arb_t, const arb_t);

  static Ball apply(Binary operation, const Ball& a, const Ball& b) {
    Ball result;
    operation(result.x_, a.x_, b.x_, kBits);
    return result;
  }
  static Ball apply(Unary function, const Ball& a) {
    Ball result;
    function(result.x_, a.x_, kBits);
    return result;
  }
  static bool decide(const Ball& a, const Ball& b, Relation yes, Relation no);

  arb_t x_;
};

}  // namespace trammel::references
