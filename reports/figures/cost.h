#pragma once

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Time over error on logarithmic axes with the efficient front; what failed in a strip at the
/// edge.
[[nodiscard]] Figure cost_figure(const CostStudy& study);

}  // namespace trammel::reports
