#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/results.h"
#include "harness/results/run_results.h"

namespace trammel::harness {

using results::Convergence;

/// Completes a series of values by observed orders, asymptotic range, Richardson extrapolation (L.
/// F. Richardson 1911) and the grid convergence index (P. J. Roache, J. Fluids Eng. 116, 1994; I.
/// B. Celik et al., J. Fluids Eng. 130, 078001, 2008).
[[nodiscard]] Convergence analyse_convergence(Convergence series);

/// Slope of log error over log size on the chosen levels (least squares); nothing below two levels.
[[nodiscard]] std::optional<double> slope(const std::vector<double>& size,
                                          const results::Numbers& error,
                                          const std::vector<bool>& chosen);

/// How well the two-term law must meet the errors of the levels that it is fitted to.
inline constexpr double kTwoTermTolerance = 0.05;

/// How many times the round-off error an error must be to say anything about the discretisation.
inline constexpr double kRoundoffMargin = 100;

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

/// Errors that are the sum of two powers, a h^p + b h^q: bending elements of order 4 joined by
/// linear axial interpolation of order 2, or a Timoshenko element, whose shear takes over on short
/// elements. Between the two no single order is observed.

struct TwoTermOrders {
  double p = 4, q = 2;  ///< orders, p > q > 0
};

/// Least squares of the relative residuals over the usable levels. Coarse levels that feel more
/// than two terms are left out one by one, until the rest is met within `within`; at least one
/// level more than coefficients stays.
/// @param error   signed, one a level, coarse to fine
/// @param usable  false where an error is round-off or missing
/// @return empty with fewer than three usable levels
[[nodiscard]] std::optional<results::TwoTermLaw> fit_two_terms(const std::vector<double>& h,
                                                               const std::vector<double>& error,
                                                               const std::vector<bool>& usable,
                                                               const TwoTermOrders& law,
                                                               double within);

/// The limit of values v = limit + a h^p + b h^q through three levels; NaN where two have one size.
[[nodiscard]] double extrapolate_two_terms(const std::array<double, 3>& h,
                                           const std::array<double, 3>& v,
                                           const TwoTermOrders& law);

}  // namespace trammel::harness
