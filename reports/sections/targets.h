#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// Published benchmark values beside independent values and what comes out; empty rows where no
/// case is labelled as a benchmark.
[[nodiscard]] Data targets_section(const Results& results, const std::vector<Family>& families);

}  // namespace trammel::reports
