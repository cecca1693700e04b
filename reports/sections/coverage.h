#pragma once

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// What is verified by what kind of evidence, and what by none.
[[nodiscard]] Data coverage_section(const Results& results);

}  // namespace trammel::reports
