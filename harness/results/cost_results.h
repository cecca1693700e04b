#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// Cost section of results.json: settings of one computation with measured error and time.
namespace trammel::results {

/// Result of one computation with a setting. Only stores contain it.
struct SandboxedRun {
  enum class Termination { failed, solved, timed_out };
  Termination termination = Termination::failed;
  std::string reason;                                     ///< reason of a failure
  std::vector<std::vector<double>> values;                ///< one list per observed quantity
  std::map<std::string, std::vector<double>> quantities;  ///< all quantities, if none is observed
  Counters counters;
  double cpu_s = 0;
};

/// Norms of the relative error over all observed values.
struct ErrorNorms {
  Number max, rms, mean;
  /// @param norm  name of a member
  [[nodiscard]] Number get(const std::string& norm) const;
};

struct SettingTime {
  std::vector<double> cpu_s;  ///< processor time of one computation, per repeat
  /// Time relative to the baseline: interval that contains the median with a probability of 98 %.
  double relative_low = 0, relative_high = 0;
  double wall_median_s = 0;
  std::size_t runs_per_measurement = 0;
};

struct CostSetting {
  std::string curve, curve_title, title, status, reason;
  Number value;                      ///< value of the parameter along the curve
  std::optional<ErrorNorms> errors;  ///< error norms of the first output
  /// Errors of each output; empty if the setting does not compute it. Only stores contain them.
  std::vector<std::optional<ErrorNorms>> output_errors;
  double cpu_s = 0;  ///< median, or time of the only trial
  Number relative;   ///< median time, relative to the baseline
  std::optional<SettingTime> time;
  Counters counters;
  bool pareto_optimal = false;

  /// Returns true if the setting has an error and a time that are used.
  [[nodiscard]] bool measured() const { return status == "measured"; }
  /// Returns true if the setting failed, diverged or timed out. The figure shows such settings in a
  /// strip at its edge.
  [[nodiscard]] bool without_result() const {
    return status == "failed" || status == "diverged" || status == "timed-out";
  }
};

struct CheapestSetting {
  double error = 0;
  /// Number of the setting; empty: no setting reaches the error.
  std::optional<std::size_t> setting;
  std::vector<std::size_t> tied;  ///< settings whose time does not differ significantly
};

/// Agreement of the Pareto fronts of two measurements; in a study, of odd and even repeats.
struct Repeatability {
  std::size_t on_both_fronts = 0, on_either_front = 0;  ///< numbers of settings
  std::size_t same_cheapest = 0, target_errors = 0;  ///< target errors reached by both measurements
  /// |ln| of the ratio of the times needed for an accuracy, over all errors of both fronts that
  /// both measurements reach. The value is a fraction: 0.1 is 10 %.
  Number median_difference, largest_difference;
};

/// Result of a study for one of its outputs, or for all of them together.
struct CostOutput {
  std::string title, scale;
  std::vector<Number> errors;  ///< of each setting, in the norm of the study; empty: no output
  std::vector<CheapestSetting> cheapest;
};

struct CostStudy {
  std::string id, family, title, description, reference_solution, scale, norm, conclusion;
  std::vector<CostSetting> settings;
  std::size_t baseline = 0;
  double wall_s = 0;
  std::vector<CheapestSetting> cheapest;
  Repeatability repeatability;
  std::vector<CostOutput> outputs;  ///< only for several outputs; the last entry covers all of them
  /// Hashes of the references by file. Only stores contain them.
  std::map<std::string, std::string> references;

  /// Returns the error of a setting in the study's norm.
  [[nodiscard]] Number error(const CostSetting& setting) const;
};

struct CostStudies {
  std::string sweep;  ///< "quick" or "full"
  std::size_t seed = 0, repeats = 0;
  double equal_within = 0, diverged_above = 0;
  std::vector<CostStudy> studies;

  [[nodiscard]] bool is_quick() const { return sweep == "quick"; }
};

}  // namespace trammel::results
