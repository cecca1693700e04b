#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// Section "cost" of results.json: error and processor time of a computation with several settings.
namespace trammel::results {

/// Result of a computation with one setting in a separate process. This result is not part of
/// results.json.
struct SandboxedRun {
  enum class Termination { failed, solved, timed_out };
  Termination termination = Termination::failed;
  std::string reason;                                     ///< reason why the computation failed
  std::vector<std::vector<double>> values;                ///< values of each observed quantity
  std::map<std::string, std::vector<double>> quantities;  ///< all quantities, if none is requested
  Counters counters;
  double cpu_s = 0;
};

/// Norms of the relative errors of all observed values: maximum, root mean square and mean.
struct ErrorNorms {
  Number max, rms, mean;
  /// @param norm  "max", "rms" or "mean"
  [[nodiscard]] Number get(const std::string& norm) const;
};

struct SettingTime {
  std::vector<double> cpu_s;  ///< processor time of each repeat of the computation
  /// Limits of the 98 % confidence interval of the median processor time, relative to the time of
  /// the baseline setting. `wall_median_s` is the median elapsed time [s].
  double relative_low = 0, relative_high = 0, wall_median_s = 0;
  std::size_t runs_per_measurement = 0;
};

struct CostSetting {
  std::string curve, curve_title, title, status, reason;
  Number value;  ///< parameter that varies along a curve, such as the number of elements
  std::optional<ErrorNorms> errors;  ///< error norms of the study's first output
  /// Error norms of each output that the setting computes. They are not part of results.json.
  std::vector<std::optional<ErrorNorms>> output_errors;
  double cpu_s = 0;  ///< processor time [s]: median of the repeats, or time of the first run
  Number relative;   ///< median time divided by the median time of the baseline setting
  std::optional<SettingTime> time;
  Counters counters;
  bool pareto_optimal = false;

  /// Returns true if the error and the time of the setting were measured.
  [[nodiscard]] bool is_measured() const { return status == "measured"; }
  /// Returns true if the setting failed, diverged or timed out. The caption of the figure that
  /// plots error against time states the number of such settings.
  [[nodiscard]] bool has_no_result() const {
    return status == "failed" || status == "diverged" || status == "timed-out";
  }
};

struct CheapestSetting {
  double error = 0;
  /// Index of the fastest setting with an error of at most `error`; empty if no setting is so
  /// accurate.
  std::optional<std::size_t> setting;
  std::vector<std::size_t> tied;  ///< settings not significantly slower than `setting`
};

/// Result of a cost study for one of its outputs, or for all outputs together.
struct CostOutput {
  std::string title, scale;
  /// Error of each setting in the norm of the study; missing if a setting has no such output.
  std::vector<Number> errors;
  std::vector<CheapestSetting> cheapest;
};

struct CostStudy {
  std::string id, family, title, description, reference_solution, scale, norm, conclusion;
  std::vector<CostSetting> settings;
  std::size_t baseline = 0;
  double wall_s = 0;
  std::vector<CheapestSetting> cheapest;
  /// Largest relative difference between the times that odd and even repeats need for the same
  /// error, over all errors that odd and even repeats reach. The value is a fraction: 0.1 is 10 %.
  Number repeatability;
  std::vector<CostOutput> outputs;  ///< empty for one output; the last entry combines all outputs
  /// Hash of each reference file that was used. The hashes are not part of results.json.
  std::map<std::string, std::string> references;

  /// Returns the error of a setting in the norm of the cost study.
  [[nodiscard]] Number error_of(const CostSetting& setting) const;
};

struct CostStudies {
  std::string sweep;  ///< measured selection of settings: "quick" or "full"
  std::size_t seed = 0, repeats = 0;
  double equal_within = 0, diverged_above = 0;
  std::vector<CostStudy> studies;

  [[nodiscard]] bool is_quick() const { return sweep == "quick"; }
};

}  // namespace trammel::results
