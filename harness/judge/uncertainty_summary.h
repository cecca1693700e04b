#pragma once

#include <cstddef>
#include <vector>

#include "harness/results/results.h"

namespace trammel::harness {

/// The bands claim about 95 %.
inline constexpr double kMinHitRate = 0.95;
/// Roache's larger factor: what the band would be if no order were ever near theory.
inline constexpr double kMaxMedianRatio = 3;
/// With fewer levels one miss decides; then nothing is judged.
inline constexpr std::size_t kMinLevels = 100;

/// Compares the bands of numerical uncertainty with exact values: how often they contain the exact
/// value, and how much wider than needed they are. A band that is huge is always right and useless.
/// Levels without a band and those whose exact value is 0 do not count. The median ratio is over
/// levels whose error is above 100 times round-off.
[[nodiscard]] results::UncertaintyCoverage summarise_numerical_uncertainty(
    const std::vector<results::Run>& runs);

}  // namespace trammel::harness
