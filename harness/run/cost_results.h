#pragma once

#include <vector>

#include "harness/base/json.h"
#include "harness/studies/cost.h"

namespace trammel::harness {

/// The "cost" of results.json, by its schema.
[[nodiscard]] Json cost_json(const std::vector<MeasuredStudy>& studies, SweepExtent extent,
                             const TimingOptions& timing);

/// The points of a study of results.json that are used for its front.
[[nodiscard]] std::vector<CostPoint> cost_points(const Json& study);

}  // namespace trammel::harness
