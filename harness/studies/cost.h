#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "harness/base/timing.h"
#include "harness/studies/cost_study.h"
#include "harness/studies/pareto_front.h"

/// Measures the computing time that an accuracy requires: the error and the time of every setting
/// (such as a mesh) of a cost study.
namespace trammel::harness {

/// Returns norms of the relative errors of all values in `computed`.
/// @param reference_solution  as many values as `computed`; an empty list for a quantity whose
///     values are errors themselves.
/// @throws std::runtime_error  if the numbers of values differ, or a scale is zero.
[[nodiscard]] results::ErrorNorms error_norms(const Observations& computed,
                                              const Observations& reference_solution,
                                              const Scale& scale);

/// Relative error above which a computation counts as diverged.
inline constexpr double kDivergedError = 10;

/// Returns the measured settings of a cost study as points of error and time. The error is that of
/// one output in the study's norm, or the largest over all outputs if `output` is empty. Settings
/// that lack an error or diverge are omitted.
/// @param first_repeat, stride  selects the repeats that are used, as in `time_ratio`
[[nodiscard]] std::vector<CostPoint> cost_points(const results::CostStudy& study,
                                                 std::optional<std::size_t> output = 0,
                                                 std::size_t first_repeat = 0,
                                                 std::size_t stride = 1);

struct CostOptions {
  TimingOptions timing;
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Measures error and processor time of all settings of a cost study.
/// @throws InputError  if the reference solution or the baseline cannot be computed.
[[nodiscard]] results::CostStudy measure_study(const CostStudy& study, const CostOptions& options,
                                               const References& references);

/// Computes the times relative to the baseline setting, the Pareto front and the conclusion of a
/// measured cost study.
void derive_time_ratios_and_front(results::CostStudy& measured);

/// Returns the section "cost" of results.json, which contains the measured cost studies.
[[nodiscard]] results::CostStudies cost_results(std::vector<results::CostStudy> studies,
                                                SweepExtent extent, const TimingOptions& timing);

}  // namespace trammel::harness
