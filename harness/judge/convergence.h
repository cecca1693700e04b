#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/two_term.h"

namespace trammel::harness {

/// One number followed along a refinement, coarse to fine. NaN where a level does not have it.
struct Series {
  std::string sweep, quantity, statistic;
  std::size_t index = 0;
  std::vector<double> parameter;  ///< the swept number
  std::vector<double> size;       ///< h, to a common factor
  std::vector<double> values;
  std::vector<double> roundoff;  ///< relative round-off error of each value
  std::optional<double> exact;
  bool is_error = false;         ///< the values are errors themselves: exact is 0, error the value
  std::string reference;         ///< where the exact value is from
  std::optional<double> theory;  ///< order that theory promises
  /// A second, lower order that takes over on fine meshes: error = a h^theory + b h^lower.
  std::optional<double> lower;
};

/// What the refinement shows. One entry a level; NaN where nothing can be said.
struct Convergence {
  Series series;
  std::vector<double> error;  ///< relative: of the exact value, else of the extrapolated one
  std::vector<double> order;  ///< observed between a level and the one before
  /// Error above 100 times the round-off error, and an order that agrees with a neighbour's within
  /// a tenth; where two orders mix, an error that the two-term law meets.
  std::vector<bool> in_asymptotic_range;
  std::vector<bool> at_roundoff_floor;  ///< error not above 100 times the round-off error
  std::optional<double> fitted_order;   ///< slope over the asymptotic range
  std::optional<double> richardson;     ///< extrapolated value; none where the values diverge
  std::optional<TwoTermFit> two_term;   ///< of the relative error; where two orders mix
  /// Grid convergence index: relative half width of where the converged value is expected, from
  /// the values alone (never from the exact one), round-off included. NaN where they diverge.
  std::vector<double> gci;
  /// Roache's factor in the band: 1.25 where the observed order is within a tenth of theory (with
  /// two orders: within a tenth of the range between them), else 3.
  std::vector<double> factor;
  bool broken = false;  ///< a level after the first finite one has no finite value
};

/// ObservedQuantity orders, asymptotic range, Richardson extrapolation (L. F. Richardson 1911) and
/// the grid convergence index (P. J. Roache, J. Fluids Eng. 116, 1994; I. B. Celik et al., J.
/// Fluids Eng. 130, 078001, 2008).
[[nodiscard]] Convergence analyse_convergence(const Series& series);

/// Slope of log error over log size on the chosen levels (least squares); nothing below two levels.
[[nodiscard]] std::optional<double> slope(const std::vector<double>& size,
                                          const std::vector<double>& error,
                                          const std::vector<bool>& chosen);

/// How well the two-term law must meet the errors of the levels that it is fitted to.
inline constexpr double kTwoTermTolerance = 0.05;

/// How many times the round-off error an error must be to say anything about the discretisation.
inline constexpr double kRoundoffMargin = 100;

}  // namespace trammel::harness
