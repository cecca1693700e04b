#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/two_term.h"

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

}  // namespace trammel::harness
