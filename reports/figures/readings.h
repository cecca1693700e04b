#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// What the most probable readings predict beside each printed row, one figure a row: the first run
/// that has probabilities, under the middle one of its discrepancies.
[[nodiscard]] std::vector<Figure> reading_figures(const CaseInfo& info,
                                                  const std::vector<const Run*>& runs);

}  // namespace trammel::reports
