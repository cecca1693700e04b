#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/cost_results.h"

/// Pareto front of accuracy and computing time.
namespace trammel::harness {

struct CostPoint {
  std::size_t setting = 0;
  double error = 0;                ///< relative error
  double time = 0;                 ///< median time, relative to the baseline setting
  double low = time, high = time;  ///< interval of that time
};

/// Replacement for an error of zero: the resolution of a double.
inline constexpr double kMinError = std::numeric_limits<double>::epsilon();

/// Relative difference below which times and errors count as equal. The median of seven repeats has
/// no better resolution, and a smaller gain of accuracy is useless. Of settings with equal times,
/// the front contains the more accurate one. Of settings that are equal in both, it contains the
/// first one of the study.
inline constexpr double kParetoTolerance = 0.05;

/// Returns true if a point belongs to the setting.
[[nodiscard]] bool has_setting(const std::vector<CostPoint>& points, std::size_t setting);

/// Returns the cheapest point with at most that error.
[[nodiscard]] std::optional<CostPoint> cheapest(const std::vector<CostPoint>& points, double error);

/// Returns the settings with at most that error whose times are indistinguishable from the
/// cheapest. Their intervals of time overlap, or nearly do.
[[nodiscard]] std::vector<std::size_t> tied_settings(const std::vector<CostPoint>& points,
                                                     double error);

/// Returns the points that are cheapest for the error of some point, or for a slightly larger
/// error; cheapest first.
[[nodiscard]] std::vector<CostPoint> find_pareto_front(const std::vector<CostPoint>& points);

/// Returns the errors in the table of cheapest settings.
[[nodiscard]] const std::vector<double>& target_errors();

/// Compares two measurements of the same settings.
[[nodiscard]] results::Repeatability compare_pareto_fronts(const std::vector<CostPoint>& a,
                                                           const std::vector<CostPoint>& b);

/// Returns an error as text: "1 %", "1e-6".
[[nodiscard]] std::string error_text(double error);

/// Describes the front in one or two sentences.
/// @param titles    of the settings
/// @param baseline  the setting that times are relative to
[[nodiscard]] std::string describe_pareto_front(const std::vector<CostPoint>& points,
                                                const std::vector<std::string>& titles,
                                                std::size_t baseline);

}  // namespace trammel::harness
