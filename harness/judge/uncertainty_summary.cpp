#include "harness/judge/uncertainty_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel {

double BandSummary::hit_rate() const {
  return levels == 0 ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(hits) / static_cast<double>(levels);
}

bool BandSummary::fails() const {
  return levels >= levels_to_judge &&
         !(hit_rate() >= least_hit_rate && median_ratio <= largest_median_ratio);
}

BandSummary summarise_bands(const std::vector<const Convergence*>& studies) {
  BandSummary summary;
  std::vector<double> ratios;
  for (const Convergence* found : studies) {
    const Series& series = found->series;
    if (!series.exact || *series.exact == 0) continue;
    for (std::size_t k = 0; k < found->band.size(); ++k) {
      if (!std::isfinite(found->band[k])) continue;
      // The band is relative to the value, the error to the exact one.
      const double band = found->band[k] * std::abs(series.values[k] / *series.exact);
      ++summary.levels;
      summary.hits += band >= found->error[k] ? 1 : 0;
      if (!found->at_roundoff_floor[k]) ratios.push_back(band / found->error[k]);
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

}  // namespace trammel
