#include "harness/judge/uncertainty_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::harness {

double NumericalUncertaintySummary::hit_rate() const {
  return levels == 0 ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(hits) / static_cast<double>(levels);
}

bool NumericalUncertaintySummary::fails() const {
  return levels >= kMinLevels && !(hit_rate() >= kMinHitRate && median_ratio <= kMaxMedianRatio);
}

NumericalUncertaintySummary summarise_numerical_uncertainty(
    const std::vector<const Convergence*>& studies) {
  NumericalUncertaintySummary summary;
  std::vector<double> ratios;
  for (const Convergence* found : studies) {
    const Series& series = found->series;
    if (!series.exact || *series.exact == 0) continue;
    for (std::size_t k = 0; k < found->gci.size(); ++k) {
      if (!std::isfinite(found->gci[k])) continue;
      // The band is relative to the value, the error to the exact one.
      const double scaled_gci = found->gci[k] * std::abs(series.values[k] / *series.exact);
      ++summary.levels;
      summary.hits += scaled_gci >= found->error[k] ? 1 : 0;
      if (!found->at_roundoff_floor[k]) ratios.push_back(scaled_gci / found->error[k]);
    }
  }
  summary.median_ratio = std::numeric_limits<double>::quiet_NaN();
  if (!ratios.empty()) {
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    summary.median_ratio = *middle;
  }
  return summary;
}

}  // namespace trammel::harness
