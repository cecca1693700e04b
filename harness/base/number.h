#pragma once

#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <vector>

namespace trammel::harness {

/// A double that may be missing, with the size of a double. Only finite values count as present.
/// Files contain null for a missing number.
class Number {
 public:
  Number() = default;
  Number(double value) : value_(value) {}     // NOLINT: conversion from a double is implicit
  Number(std::nullopt_t) {}                   // NOLINT
  Number(const std::optional<double>& value)  // NOLINT
      : value_(value.value_or(kMissing)) {}

  [[nodiscard]] bool has_value() const { return std::isfinite(value_); }
  explicit operator bool() const { return has_value(); }
  /// Returns the stored double, which is not finite if the number is missing.
  [[nodiscard]] double operator*() const { return value_; }
  [[nodiscard]] double value_or(double other) const { return has_value() ? value_ : other; }
  /// @throws std::bad_optional_access  if the number is missing.
  [[nodiscard]] double value() const {
    return has_value() ? value_ : throw std::bad_optional_access();
  }
  void reset() { value_ = kMissing; }

  friend bool operator==(Number a, Number b) { return std::is_eq(a <=> b); }
  /// Compares two numbers. Missing numbers are equal, and less than all present numbers.
  friend std::partial_ordering operator<=>(Number a, Number b) {
    if (a.has_value() && b.has_value()) return *a <=> *b;
    return a.has_value() <=> b.has_value();
  }

 private:
  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  double value_ = kMissing;
};

using Numbers = std::vector<Number>;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace trammel::harness
