#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// What results.json says under /cost: settings of one computation, measured for error and time.
namespace trammel::results {

/// Result of one computation of a setting. Only stores hold it.
struct SandboxedRun {
  enum class Termination { failed, solved, timed_out };
  Termination termination = Termination::failed;
  std::string reason;                                     ///< of a failure
  std::vector<std::vector<double>> values;                ///< a list for each observed quantity
  std::map<std::string, std::vector<double>> quantities;  ///< all, if none is observed
  Counters counters;
  double cpu_s = 0;
};

/// Norms of the relative error over all observed values.
struct ErrorNorms {
  Number max, rms, mean;
  /// @param norm  the name of a member
  [[nodiscard]] Number get(const std::string& norm) const;
};

struct SettingTime {
  std::vector<double> cpu_s;  ///< of one computation, by repeat
  /// Over the baseline's: the interval that holds the median with a probability of 98 %.
  double relative_low = 0, relative_high = 0;
  double wall_median_s = 0;
  std::size_t runs_per_measurement = 0;
};

struct CostSetting {
  std::string curve, curve_title, title, status, reason;
  Number value;                      ///< along the curve
  std::optional<ErrorNorms> errors;  ///< of the first output
  /// Of each output; empty if the setting does not give it. Only stores hold them.
  std::vector<std::optional<ErrorNorms>> output_errors;
  double cpu_s = 0;  ///< median, or of the one trial
  Number relative;   ///< to the baseline's
  std::optional<SettingTime> time;
  Counters counters;
  bool pareto_optimal = false;

  /// Whether it has an error and a time that are used.
  [[nodiscard]] bool measured() const { return status == "measured"; }
  /// Whether it belongs into the strip at the edge: it failed, diverged or was not done in time.
  [[nodiscard]] bool without_result() const {
    return status == "failed" || status == "diverged" || status == "timed-out";
  }
};

struct CheapestSetting {
  double error = 0;
  std::optional<std::size_t> setting;  ///< its number; none within that error: empty
  std::vector<std::size_t> tied;       ///< settings whose time cannot be told from it
};

/// Agreement of the Pareto fronts of two measurements, in a study those of odd and even repeats.
struct Repeatability {
  std::size_t on_both_fronts = 0, on_either_front = 0;  ///< settings
  std::size_t same_cheapest = 0, target_errors = 0;     ///< target errors that both reach
  /// |ln| of the ratio of the times that an accuracy takes, over all errors of both fronts that
  /// both reach; as a share: 0.1 is 10 %.
  Number median_difference, largest_difference;
};

/// What a study of several outputs finds for one of them, or for all at once.
struct CostOutput {
  std::string title, scale;
  std::vector<Number> errors;  ///< by setting, in the study's norm; none where it is not given
  std::vector<CheapestSetting> cheapest;
};

struct CostStudy {
  std::string id, family, title, description, reference_solution, scale, norm, conclusion;
  std::vector<CostSetting> settings;
  std::size_t baseline = 0;
  double wall_s = 0;
  std::vector<CheapestSetting> cheapest;
  Repeatability repeatability;
  std::vector<CostOutput> outputs;  ///< where there are several; all at once is the last
  /// Hashes of the references by file. Only stores hold them.
  std::map<std::string, std::string> references;

  /// The error of a setting in the study's norm.
  [[nodiscard]] Number error(const CostSetting& setting) const;
};

struct CostStudies {
  std::string sweep;  ///< quick or full
  std::size_t seed = 0, repeats = 0;
  double equal_within = 0, diverged_above = 0;
  std::vector<CostStudy> studies;

  [[nodiscard]] bool is_quick() const { return sweep == "quick"; }
};

}  // namespace trammel::results
