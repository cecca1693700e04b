#pragma once

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The provenance of all references used.
[[nodiscard]] Data references_section(const Results& results);

}  // namespace trammel::reports
