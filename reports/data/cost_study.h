#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/data/json_view.h"

namespace trammel::reports {

/// What results.json says under /cost: settings of one computation, measured for error and time.

struct CostSetting {
  std::string curve, curve_title, title, status, reason;
  std::optional<double> value;           ///< along the curve
  std::optional<double> max, rms, mean;  ///< norms of the relative error
  std::optional<double> error;           ///< the one of the study's norm
  double cpu_s = 0;                      ///< median, or of the one trial
  std::optional<double> relative;        ///< to the baseline's
  std::optional<double> lower, upper;    ///< quartiles, relative to the baseline's median
  std::optional<double> spread;          ///< quartile distance over median
  std::vector<std::pair<std::string, double>> counters;
  bool pareto_optimal = false;

  /// Whether it has an error and a time that are used.
  [[nodiscard]] bool measured() const { return status == "measured"; }
  /// Whether it belongs into the strip at the edge: it failed, diverged or was not done in time.
  [[nodiscard]] bool without_result() const {
    return status == "failed" || status == "diverged" || status == "timed-out";
  }
};

struct CostStudy {
  std::string id, family, title, description, reference_solution, scale, norm, conclusion;
  std::vector<CostSetting> settings;
  std::size_t baseline = 0;
  double wall_s = 0;
  /// An error, and the number of the cheapest setting within it.
  std::vector<std::pair<double, std::optional<std::size_t>>> cheapest;
  std::size_t on_both_fronts = 0,
              on_either_front = 0;  ///< settings on the fronts of odd and even repeats
  double largest_difference = 0;    ///< between these two in what an accuracy costs
};

struct CostStudies {
  bool quick = false;
  int repeats = 0;
  double kMaxSpread = 0;
  std::vector<CostStudy> studies;
};

/// @throws std::runtime_error  "/pointer: what was expected"
[[nodiscard]] CostStudies read_cost_studies(const JsonView& view);

/// "192 element evaluations, 2 factorizations".
[[nodiscard]] std::string counters_text(
    const std::vector<std::pair<std::string, double>>& counters);

}  // namespace trammel::reports
