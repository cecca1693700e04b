#pragma once

#include <array>
#include <optional>
#include <vector>

#include "harness/results/run_results.h"

/// Errors that are the sum of two powers, a h^p + b h^q: bending elements of order 4 joined by
/// linear axial interpolation of order 2, or a Timoshenko element, whose shear takes over on short
/// elements. Between the two no single order is observed.
namespace trammel::harness {

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
