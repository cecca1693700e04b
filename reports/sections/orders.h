#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// Observed orders beside those of theory, and the coverage of the numerical uncertainty.
[[nodiscard]] Data orders_section(const Results& results, const std::vector<Family>& families);

}  // namespace trammel::reports
