#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Log-log error over one sweep of one quantity, all its indices together.
[[nodiscard]] std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run);

}  // namespace trammel::reports
