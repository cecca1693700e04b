#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Differences that are known, with the recorded range of each: one figure a check name.
[[nodiscard]] std::vector<Figure> discrepancy_figures(const CaseInfo& info, const Results& results,
                                                      const std::vector<const Run*>& runs);

}  // namespace trammel::reports
