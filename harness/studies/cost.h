#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/timing.h"
#include "harness/studies/cost_study.h"
#include "harness/studies/pareto_front.h"
#include "harness/studies/sandboxed_run.h"

/// What accuracy costs: every setting of a study measured for error and for time.
namespace trammel::harness {

/// Norms of the relative errors over all observed entries; all three are kept.
struct ErrorNorms {
  double max = 0, rms = 0, mean = 0;
  [[nodiscard]] double get(Norm norm) const;
};

/// @param reference_solution  as many values as `found`; empty lists where the values are errors
/// themselves
/// @throws std::runtime_error  where they differ in length, or there is nothing to divide by.
[[nodiscard]] ErrorNorms error_norms(const Observations& found,
                                     const Observations& reference_solution, const Scale& scale);

/// An error above this is no approximation any more: the computation counts as diverged.
inline constexpr double kDivergedError = 10;

struct MeasuredSetting {
  enum class MeasurementStatus {
    measured,
    reference_solution,  ///< what the others are measured against
    diverged,            ///< not finite, or the error is above `kDivergedError`
    timed_out,           ///< not done within the processor time allowed
    failed               ///< no solution; the reason says why
  };
  MeasurementStatus status = MeasurementStatus::failed;
  std::string reason;
  std::optional<ErrorNorms> error;  ///< of the study's first output
  /// Of each output; none where the setting does not give it.
  std::vector<std::optional<ErrorNorms>> output_errors;
  std::optional<Timing> timing;
  RelativeTime relative;  ///< to the baseline; without repeats the one trial's
  double cpu_s = 0;       ///< median; of the one trial where it was not timed
  solver::Counters counters;
};

struct MeasuredStudy {
  CostStudy study;
  std::vector<MeasuredSetting> settings;  ///< as in the study
  std::vector<CostPoint> points;          ///< settings that are used, by the study's norm
  std::vector<CostPoint> pareto_front;
  std::string conclusion;
  /// The fronts that odd and even repeats give by themselves.
  ParetoFrontAgreement repeatability;
  double wall_s = 0;  ///< that the whole study took
};

/// The settings that were measured, by one output's error in the study's norm, or where none is
/// named by the largest of all outputs' errors; without those that do not give it or diverge in it.
[[nodiscard]] std::vector<CostPoint> output_points(const MeasuredStudy& measured,
                                                   std::optional<std::size_t> output);

struct CostOptions {
  TimingOptions timing;
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// @throws InputError  where the truth or the baseline cannot be computed: nothing can be said
/// then.
[[nodiscard]] MeasuredStudy measure(CostStudy study, const CostOptions& options,
                                    const References& references);

/// What follows from errors and times: the times relative to the baseline, the front, the words.
void derive_results(MeasuredStudy& measured);

[[nodiscard]] const char* to_string(MeasuredSetting::MeasurementStatus status);

}  // namespace trammel::harness
