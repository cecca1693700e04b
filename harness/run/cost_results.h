#pragma once

#include <vector>

#include "harness/results/cost_results.h"
#include "harness/studies/cost.h"

namespace trammel::harness {

[[nodiscard]] results::CostStudy study_results(const MeasuredStudy& measured);

/// What results.json says of accuracy and computing time.
[[nodiscard]] results::CostStudies cost_results(const std::vector<MeasuredStudy>& studies,
                                                SweepExtent extent, const TimingOptions& timing);

/// The points of a study of results.json that are used for its Pareto front.
[[nodiscard]] std::vector<CostPoint> cost_points(const results::CostStudy& study);

}  // namespace trammel::harness
