#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "harness/results/results.h"
#include "harness/results/run_results.h"

namespace trammel::harness {

using results::Convergence;

/// Adds the results of a convergence study to a series of values: observed orders, asymptotic
/// range, Richardson extrapolation (L. F. Richardson 1911) and the grid convergence index (P. J.
/// Roache, J. Fluids Eng. 116, 1994; I. B. Celik et al., J. Fluids Eng. 130, 078001, 2008).
[[nodiscard]] Convergence analyze_convergence(Convergence series);

/// Returns the least-squares slope of log error over log element size on the chosen refinement
/// levels; empty for fewer than two levels.
[[nodiscard]] std::optional<double> log_log_slope(const std::vector<double>& size,
                                                  const results::Numbers& error,
                                                  const std::vector<bool>& chosen);

/// Largest allowed relative misfit of the error law a h^p + b h^q on the refinement levels used for
/// its fit.
inline constexpr double kTwoTermTolerance = 0.05;

/// Minimum ratio of an error to its round-off error. Below this ratio, round-off error hides the
/// discretization error.
inline constexpr double kRoundoffMargin = 100;

/// Required fraction of refinement levels whose uncertainty band contains the exact value (hit
/// rate). The bands claim a coverage of about 95 %.
inline constexpr double kMinHitRate = 0.95;
/// Limit of the median ratio of uncertainty band to true error: the larger of Roache's safety
/// factors. This factor applies if no observed order is close to the theoretical order.
inline constexpr double kMaxMedianRatio = 3;
/// Minimum number of refinement levels for a judgment of the uncertainty bands. With fewer levels,
/// a single band that does not contain the exact value would decide the verdict.
inline constexpr std::size_t kMinLevels = 100;

/// Compares uncertainty bands (grid convergence index) with exact values: the hit rate, and the
/// band width relative to the error. The width matters because an excessively wide band always
/// contains the exact value. Refinement levels without a band, or with an exact value of 0, are
/// excluded. The median ratio only includes levels with an error above 100 times the round-off
/// error.
[[nodiscard]] results::UncertaintyCoverage summarize_numerical_uncertainty(
    const std::vector<results::Run>& runs);

/// Errors that are the sum of two powers of the element size h, a h^p + b h^q. One example is beam
/// elements with bending of order 4 and linear axial interpolation of order 2. Another example is
/// Timoshenko elements, in which shear dominates on short elements. Between coarse and fine meshes
/// no single order is observed.

struct TwoTermOrders {
  double p = 4, q = 2;  ///< orders, p > q > 0
};

/// Fits the law a h^p + b h^q by least squares of the relative residuals over the usable refinement
/// levels. The coarsest levels, whose errors contain further terms, are removed one by one until
/// the largest relative residual is at most `max_residual`. At least three levels remain.
/// @param error   signed error on each refinement level, coarse to fine.
/// @param usable  false if an error is missing or dominated by round-off.
/// @return empty for fewer than three usable levels
[[nodiscard]] std::optional<results::TwoTermLaw> fit_two_term_error_law(
    const std::vector<double>& h, const std::vector<double>& error, const std::vector<bool>& usable,
    const TwoTermOrders& law, double max_residual);

/// Fits v = limit + a h^p + b h^q to the values v on three refinement levels, and returns the
/// limit. Returns NaN if two levels have the same element size h.
[[nodiscard]] double extrapolate_two_term_law(const std::array<double, 3>& h,
                                              const std::array<double, 3>& v,
                                              const TwoTermOrders& law);

}  // namespace trammel::harness
