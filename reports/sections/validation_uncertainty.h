#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// Differences from the paper beside their validation uncertainty, after ASME V&V 20.
[[nodiscard]] Data validation_uncertainty_section(const Results& results,
                                                  const std::vector<Family>& families);

}  // namespace trammel::reports
