#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/cost_results.h"

/// The efficient front: what each accuracy costs at least.
namespace trammel::harness {

struct CostPoint {
  std::size_t setting = 0;
  double error = 0;                ///< relative
  double time = 0;                 ///< over the baseline's, median
  double low = time, high = time;  ///< that time's interval
};

/// What an error of zero counts as: a double cannot tell less.
inline constexpr double kMinError = std::numeric_limits<double>::epsilon();

/// Times and errors nearer than this count as equal: a median of seven is not known better, and an
/// accuracy that differs by less is of no use. Of equal settings the more accurate counts, of
/// equally accurate ones the first of the study.
inline constexpr double kParetoTolerance = 0.05;

/// Whether one of the points is of that setting.
[[nodiscard]] bool has_setting(const std::vector<CostPoint>& points, std::size_t setting);

/// The cheapest point with at most that error.
[[nodiscard]] std::optional<CostPoint> cheapest(const std::vector<CostPoint>& points, double error);

/// Settings with at most that error that the measurement cannot tell from the cheapest: their
/// intervals of time meet, or nearly.
[[nodiscard]] std::vector<std::size_t> tied_settings(const std::vector<CostPoint>& points,
                                                     double error);

/// What is cheapest for the error of any point, or for one a little above; cheapest first.
[[nodiscard]] std::vector<CostPoint> find_pareto_front(const std::vector<CostPoint>& points);

/// The errors that the table of cheapest settings asks for.
[[nodiscard]] const std::vector<double>& target_errors();

/// Compares two measurements of the same settings.
[[nodiscard]] results::Repeatability compare_pareto_fronts(const std::vector<CostPoint>& a,
                                                           const std::vector<CostPoint>& b);

/// "1 %", "1e-6".
[[nodiscard]] std::string error_text(double error);

/// What the front says, in a sentence or two.
/// @param titles    of the settings
/// @param baseline  the setting that times are relative to
[[nodiscard]] std::string describe_pareto_front(const std::vector<CostPoint>& points,
                                                const std::vector<std::string>& titles,
                                                std::size_t baseline);

}  // namespace trammel::harness
