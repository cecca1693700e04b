#include <algorithm>
#include <cmath>

#include "harness/base/statistic.h"
#include "harness/judge/convergence.h"

namespace trammel::harness {

results::UncertaintyCoverage summarize_numerical_uncertainty(
    const std::vector<results::Run>& runs) {
  results::UncertaintyCoverage summary;
  summary.min_levels = kMinLevels;
  summary.min_coverage = kMinHitRate;
  summary.max_median_ratio = kMaxMedianRatio;
  std::vector<double> ratios;
  const auto add = [&](const results::Convergence& found) {
    if (found.exact.value_or(0) == 0) return;
    for (std::size_t k = 0; k < found.gci.size(); ++k) {
      if (!found.gci[k]) continue;
      // The GCI is relative to the computed value; the error is relative to the exact value.
      const double scaled_gci = *found.gci[k] * std::abs(*found.values[k] / *found.exact);
      ++summary.levels;
      summary.covered += scaled_gci >= *found.error[k] ? 1 : 0;
      if (!found.at_roundoff_floor[k]) ratios.push_back(scaled_gci / *found.error[k]);
    }
  };
  for (const results::Run& run : runs) std::ranges::for_each(run.convergence, add);
  if (summary.levels > 0)
    summary.coverage = static_cast<double>(summary.covered) / static_cast<double>(summary.levels);
  if (!ratios.empty()) summary.median_ratio = quantile(std::move(ratios), 0.5);
  summary.passes = summary.levels < summary.min_levels ||
                   (*summary.coverage >= kMinHitRate && *summary.median_ratio <= kMaxMedianRatio);
  return summary;
}

}  // namespace trammel::harness
