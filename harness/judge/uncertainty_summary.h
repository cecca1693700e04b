#pragma once

#include <cstddef>
#include <vector>

#include "harness/judge/convergence.h"

namespace trammel::harness {

/// How good the bands of numerical uncertainty are, where exact values tell: how often they hold
/// the exact value, and how much wider than needed they are. A band that is always right because it
/// is huge is no good.
struct NumericalUncertaintySummary {
  std::size_t levels = 0;  ///< with a band and an exact value other than 0
  std::size_t hits = 0;    ///< where the band holds the exact value
  /// Of band over true error, over the levels whose error is above 100 times round-off; NaN where
  /// there is none.
  double median_ratio = 0;

  [[nodiscard]] double hit_rate() const;  ///< NaN without levels
  /// Enough levels to judge by, and too few hits or too wide bands.
  [[nodiscard]] bool fails() const;
};

/// The bands claim about 95 %.
inline constexpr double kMinHitRate = 0.95;
/// Roache's larger factor: what the band would be if no order were ever near theory.
inline constexpr double kMaxMedianRatio = 3;
/// Below so many levels one miss decides; then nothing is judged.
inline constexpr std::size_t kMinLevels = 100;

[[nodiscard]] NumericalUncertaintySummary summarise_numerical_uncertainty(
    const std::vector<const Convergence*>& studies);

}  // namespace trammel::harness
