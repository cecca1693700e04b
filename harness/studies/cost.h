#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "harness/base/timing.h"
#include "harness/studies/cost_study.h"
#include "harness/studies/pareto_front.h"

/// What accuracy costs: every setting of a study measured for error and for time.
namespace trammel::harness {

/// Norms of the relative errors over all observed entries; all three are kept.
/// @param reference_solution  as many values as `found`; empty lists where the values are errors
/// themselves
/// @throws std::runtime_error  where they differ in length, or there is nothing to divide by.
[[nodiscard]] results::ErrorNorms error_norms(const Observations& found,
                                              const Observations& reference_solution,
                                              const Scale& scale);

/// An error above this is no approximation any more: the computation counts as diverged.
inline constexpr double kDivergedError = 10;

/// The settings that were measured, by one output's error in the study's norm, or where none is
/// named by the largest of all outputs' errors; without those that do not give it or diverge in it.
/// @param first, step  the repeats that count, as in `relative_time`
[[nodiscard]] std::vector<CostPoint> cost_points(const results::CostStudy& study,
                                                 std::optional<std::size_t> output = 0,
                                                 std::size_t first = 0, std::size_t step = 1);

struct CostOptions {
  TimingOptions timing;
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// @throws InputError  where the truth or the baseline cannot be computed: nothing can be said
/// then.
[[nodiscard]] results::CostStudy measure(const CostStudy& study, const CostOptions& options,
                                         const References& references);

/// What follows from errors and times: the times relative to the baseline, the front, the words.
void derive_results(results::CostStudy& measured);

/// What results.json says of accuracy and computing time.
[[nodiscard]] results::CostStudies cost_results(std::vector<results::CostStudy> studies,
                                                SweepExtent extent, const TimingOptions& timing);

}  // namespace trammel::harness
