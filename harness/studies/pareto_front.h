#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/cost_results.h"

/// Pareto front of accuracy and computing time: settings that no other setting surpasses in both.
namespace trammel::harness {

struct CostPoint {
  std::size_t setting = 0;
  double error = 0;                ///< relative error
  double time = 0;                 ///< median time, relative to the baseline setting
  double low = time, high = time;  ///< confidence interval of the time
};

/// Smallest error of a point of the Pareto front, equal to the resolution of a double. It replaces
/// an error of zero.
inline constexpr double kMinError = std::numeric_limits<double>::epsilon();

/// Relative difference below which times and errors count as equal. The median time of seven
/// repeats has no better resolution. Of settings with equal times, the Pareto front contains the
/// more accurate one. If the errors are also equal, it contains the first setting of the study.
inline constexpr double kParetoTolerance = 0.05;

/// Returns true if one of the points belongs to the setting with the index `setting`.
[[nodiscard]] bool has_point_of_setting(const std::vector<CostPoint>& points, std::size_t setting);

/// Returns the fastest point whose error is at most `error`; empty if there is none.
[[nodiscard]] std::optional<CostPoint> fastest_allowed(const std::vector<CostPoint>& points,
                                                       double error);

/// Returns the settings with an error of at most `error` that are not significantly slower than the
/// fastest of these settings: the confidence intervals of the times overlap, up to a gap of
/// kParetoTolerance.
[[nodiscard]] std::vector<std::size_t> tied_settings(const std::vector<CostPoint>& points,
                                                     double error);

/// Returns the Pareto front, fastest point first. For each given point, it contains the fastest
/// point whose error is not larger than that of the given point, up to kParetoTolerance.
[[nodiscard]] std::vector<CostPoint> find_pareto_front(const std::vector<CostPoint>& points);

/// Returns the target errors for which the report lists the fastest settings.
[[nodiscard]] const std::vector<double>& target_errors_of_report();

/// Returns the largest relative difference between the times of two Pareto fronts for the same
/// error, over all errors that both fronts reach. The fronts are two measurements of the same
/// settings.
[[nodiscard]] double compare_pareto_fronts(const std::vector<CostPoint>& a,
                                           const std::vector<CostPoint>& b);

/// Returns an error as text: "1 %", "1e-6".
[[nodiscard]] std::string error_text(double error);

/// Describes the Pareto front in one or two sentences.
/// @param titles    titles of the settings
/// @param baseline  index of the setting to which times are relative
[[nodiscard]] std::string describe_pareto_front(const std::vector<CostPoint>& points,
                                                const std::vector<std::string>& titles,
                                                std::size_t baseline);

}  // namespace trammel::harness
