#pragma once

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The claims of the publication under examination, each with what was measured and a verdict;
/// empty where the results have no claims.
[[nodiscard]] Data claims_section(const Results& results);

}  // namespace trammel::reports
